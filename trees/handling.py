"""Leaves that use the robot's hand; what the fingers feel decides whether they succeed."""

from abc import abstractmethod

from py_trees.common import Status

from executive.records import Activity
from executive.types.goals import Goal, Halt, Pick, PutDown
from executive.types.home import FLOOR, SOMETHING
from executive.types.results import Failed, Result, Succeeded
from trees.body import RobotAction
from trees.context import MissionContext


class PickUp(RobotAction):
    """Grasps the thing where it was seen, and lifts it.

    Reads search.detection, search.found and hand.felt; writes hand.reached_for and hand.in_hand;
    clears hand.lost and hand.unplaced.
    """

    activity = Activity.HANDLING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Begin with no grasp."""
        super().__init__(name, context)
        self._finished = False

    def initialise(self) -> None:
        """Send the goal; the robot may finish once more."""
        self._finished = False
        super().initialise()

    def goal(self) -> Goal:
        """Pick up what was detected."""
        assert self.situation.search.detection
        self.situation.hand.reached_for = self.situation.search.detection.label
        return Pick(self.situation.search.detection)

    def ended(self, result: Result) -> Status:
        """Note what is in the hand; remember that the thing was taken.

        If the robot has failed, but has the thing in its hand, it gets one more try to finish; then
        that counts as a success.
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
        """Treat it as a failure of the robot if it has the thing; note that it may still move."""
        hand, seen = self.situation.hand, self.situation.search.detection
        assert seen
        if not (hand.felt and hand.in_hand == seen.label):
            return super().out_of_time()
        status = self.ended(Failed(f"it took longer than {self._patience_s:g} s"))
        self.situation.ending.restless = True
        return status


class PutDownAction(RobotAction):
    """Puts down the held thing.

    Reads hand.in_hand and hand.felt; writes hand.in_hand and hand.put_at.
    """

    activity = Activity.HANDLING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Begin with nothing held."""
        super().__init__(name, context)
        self._held: str | None = None

    @abstractmethod
    def place(self) -> str:
        """The furniture to put it on."""

    def goal(self) -> Goal:
        """Put it there; keep its name, which the hand will not tell afterwards."""
        self._held = self.situation.hand.in_hand
        return PutDown(self.place())

    def ended(self, result: Result) -> Status:
        """Remember that the thing is here now, and that the hand is empty."""
        if isinstance(result, Succeeded) and self.situation.hand.felt:
            result = Failed("my fingers do not let go of it")
        if isinstance(result, Succeeded):
            place = self.place()
            if self._held and self._held != SOMETHING:
                self.context.facts.put(self._held, place)
            self.situation.hand.in_hand, self.situation.hand.put_at = None, place
        return super().ended(result)


class PutDownAt(PutDownAction):
    """Puts the held thing down at a fixed place."""

    def __init__(self, name: str, context: MissionContext, place: str) -> None:
        """Name the place."""
        super().__init__(name, context)
        self._place = place

    def place(self) -> str:
        """The place that the tree names."""
        return self._place


class PutDownThere(PutDownAction):
    """Puts the held thing down on the chosen furniture.

    Reads hand.surface.
    """

    def place(self) -> str:
        """The chosen furniture."""
        return self.situation.hand.surface


class PutDownAtGoal(PutDownAction):
    """Puts the held thing down at the goal of the command.

    Reads request.goal.
    """

    def place(self) -> str:
        """The chosen goal."""
        return self.situation.request.goal


class ComeToRest(RobotAction):
    """Halts, so that the fingers tell what is in the hand; always fails, and so tries what follows.

    Reads and writes agenda.unsettled.
    """

    activity = Activity.HANDLING

    def goal(self) -> Goal:
        """Halt."""
        return Halt()

    def ended(self, result: Result) -> Status:
        """Note that it is known now what the hand holds."""
        self.situation.agenda.unsettled = False
        super().ended(result)
        return Status.FAILURE
