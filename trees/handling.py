"""Leaves that use the robot's hand: what the fingers feel decides."""

from abc import abstractmethod

from py_trees.common import Status

from executive.records import Activity
from executive.types.goals import Goal, Halt, Pick, PutDown
from executive.types.home import FLOOR, SOMETHING
from executive.types.results import Failed, Result, Succeeded
from trees.body import RobotAction
from trees.context import MissionContext


class PickUp(RobotAction):
    """Grasps the thing where it was seen, and lifts it; what the fingers feel decides.

    Reads search.detection, search.found and hand.felt; writes hand.reached_for and hand.in_hand,
    clears hand.lost and hand.unplaced.
    """

    activity = Activity.HANDLING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Reach for it."""
        super().__init__(name, context)
        self._finished = False

    def initialise(self) -> None:
        """Begin."""
        self._finished = False
        super().initialise()

    def goal(self) -> Goal:
        """Pick what was detected."""
        assert self.situation.search.detection
        self.situation.hand.reached_for = self.situation.search.detection.label
        return Pick(self.situation.search.detection)

    def ended(self, result: Result) -> Status:
        """Remember that it is no longer there.

        If the robot failed with the thing in its hand, it is given one chance to finish.
        """
        hand, search = self.situation.hand, self.situation.search
        assert search.detection
        name = search.detection.label
        if isinstance(result, Succeeded) and hand.felt is False:
            result = Failed(f"{self.context.say.the(name)} slipped from my fingers")
        if isinstance(result, Failed) and hand.felt and hand.in_hand == name:
            if not self._finished:
                self._finished = True
                return self.start_again()
            result = Succeeded()
        if isinstance(result, Succeeded):
            hand.in_hand, hand.lost = name, ""
            hand.unplaced.clear()
            self.context.facts.took(name, search.found.place if search.found else FLOOR)
        return super().ended(result)

    def out_of_time(self) -> Status:
        """With the thing in the hand it is as if the robot had failed; only that it may move."""
        hand, seen = self.situation.hand, self.situation.search.detection
        assert seen
        if not (hand.felt and hand.in_hand == seen.label):
            return super().out_of_time()
        status = self.ended(Failed(f"it took longer than {self._patience_s:g} s"))
        self.situation.ending.restless = True
        return status


class PutDownAction(RobotAction):
    """Puts the held thing down.

    Reads hand.in_hand and hand.felt; writes hand.in_hand and hand.put_at.
    """

    activity = Activity.HANDLING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Hold nothing yet."""
        super().__init__(name, context)
        self._held: str | None = None

    @abstractmethod
    def place(self) -> str:
        """Where to."""

    def goal(self) -> Goal:
        """Put it there; afterwards the hand does not tell what it was."""
        self._held = self.situation.hand.in_hand
        return PutDown(self.place())

    def ended(self, result: Result) -> Status:
        """Remember that it is here now."""
        if isinstance(result, Succeeded) and self.situation.hand.felt:
            result = Failed("my fingers do not let go of it")
        if isinstance(result, Succeeded):
            place = self.place()
            if self._held and self._held != SOMETHING:
                self.context.facts.put(self._held, place)
            self.situation.hand.in_hand, self.situation.hand.put_at = None, place
        return super().ended(result)


class PutDownAt(PutDownAction):
    """Puts the held thing down at a place that the tree names."""

    def __init__(self, name: str, context: MissionContext, place: str) -> None:
        """Name the place."""
        super().__init__(name, context)
        self._place = place

    def place(self) -> str:
        """That one."""
        return self._place


class PutDownThere(PutDownAction):
    """Puts the held thing down on the surface at hand.

    Reads hand.surface.
    """

    def place(self) -> str:
        """The surface that was chosen."""
        return self.situation.hand.surface


class PutDownAtGoal(PutDownAction):
    """Puts the held thing down where it is to go.

    Reads request.goal.
    """

    def place(self) -> str:
        """The goal that was chosen."""
        return self.situation.request.goal


class ComeToRest(RobotAction):
    """Stands still, so that the fingers tell what was got hold of; always fails: then one goes on.

    Reads and writes agenda.unsettled.
    """

    activity = Activity.HANDLING

    def goal(self) -> Goal:
        """Do nothing."""
        return Halt()

    def ended(self, result: Result) -> Status:
        """What the hand holds is known by now."""
        self.situation.agenda.unsettled = False
        super().ended(result)
        return Status.FAILURE
