"""The base classes of leaves that act with the robot's body or camera.

The leaves themselves are in `trees/driving.py`, `trees/looking.py` and `trees/handling.py`.
"""

from abc import abstractmethod

from py_trees.common import Status

from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
from executive.types.home import SOMETHING
from executive.types.results import Failed, Result, Succeeded
from trees.context import MissionContext
from trees.nodes import UNSAID, Action, why_of
from trees.telling import tell


class BodyAction(Action):
    """An action of the robot's body or camera.

    Every failure and every timeout is noted by `note_failure`, and gets a reason in words.
    """

    def __init__(self, name: str, context: MissionContext) -> None:
        """The action may take as long as the parameters allow."""
        super().__init__(name, context, context.parameters.action_s)

    @abstractmethod
    def attempt(self) -> str:
        """What the action tries, to follow "I could not"."""

    @abstractmethod
    def note_failure(self, why: str) -> None:
        """Note in the situation what is unknown, or cannot be done, because this failed."""

    def failed(self, result: Result) -> Status:
        """Fail with the reason that the robot gives."""
        why = self.why(result)
        self.note_failure(why)
        return self.fail(f"I could not {self.attempt()}: {why}" if why == UNSAID else why)

    def why(self, result: Result) -> str:
        """The robot's reason, with words in place of its names of things and places."""
        return self.context.say.in_words(why_of(result))

    def out_of_time(self) -> Status:
        """Fail because it took too long."""
        why = f"it took longer than {self._patience_s:g} s"
        self.note_failure(why)
        return self.fail(f"I could not {self.attempt()}: {why}")


class RobotAction(BodyAction):
    """Sends one goal to the robot.

    Writes ending.restless. A drive writes dialogue.at, dialogue.stands and dialogue.heads_for. If
    the robot loses what it holds, hand.lost and hand.in_hand are written. A failure is noted in
    search.looks or hand.unplaced.
    """

    searches = False
    """Whether it is part of a search, so that a place stays unseen if it fails."""

    def __init__(self, name: str, context: MissionContext) -> None:
        """Begin without a goal."""
        super().__init__(name, context)
        self._goal: Goal = Halt()

    @abstractmethod
    def goal(self) -> Goal:
        """The goal for the robot."""

    def progress(self) -> str:
        """What to tell the person at the start; empty if they know it already."""
        return ""

    def start(self) -> int:
        """Send the goal to the robot, and tell the person."""
        if said := self.progress():
            tell(self.context, said)
        self._goal = self.goal()
        self.feedback_message = _in_words(self._goal)
        self.situation.ending.restless = True
        if isinstance(self._goal, DriveTo):
            self.situation.dialogue.stands = ""
            self.situation.dialogue.heads_for = self._goal.place
        return self.context.robot.start(self._goal)

    def ended(self, result: Result) -> Status:
        """Succeed or fail as the robot did; note where it is, and whether it lost a thing."""
        self.situation.ending.restless = not isinstance(result, Succeeded)
        if isinstance(result, Succeeded):
            if isinstance(self._goal, DriveTo):
                self.situation.dialogue.at = self.situation.dialogue.stands = self._goal.place
            return Status.SUCCESS
        if isinstance(result, Failed) and result.lost:
            self.situation.hand.lost, self.situation.hand.in_hand = self.why(result), None
        return self.failed(result)

    def doing(self) -> str:
        """It pursues its goal."""
        say = self.context.say
        match self._goal:
            case DriveTo(place):
                return f"drive to {say.the(place)}"
            case LookAt(place):
                return f"look {say.at(place)}"
            case Pick(detection):
                return f"pick up {say.the(detection.label)}"
            case PutDown(place):
                return f"put {say.the(self.situation.hand.in_hand or SOMETHING)} {say.at(place)}"
            case Halt():
                return "stop"

    def attempt(self) -> str:
        """It is to reach its goal."""
        say = self.context.say
        match self._goal:
            case DriveTo(place):
                return f"get to {say.the(place)}"
            case LookAt(place):
                return f"look at {say.the(place)}"
            case Pick(detection):
                return f"pick up {say.the(detection.label)}"
            case PutDown(place):
                it = say.it(self.situation.request.object or SOMETHING)
                return f"put {it} down {say.at(place)}"
            case Halt():
                return "stop"

    def note_failure(self, why: str) -> None:
        """Note why a place was not reached or not seen, or why a thing was not put down there."""
        match self._goal:
            case DriveTo(place) if self.searches:
                self.situation.search.looks.not_reached(place, why)
            case LookAt(place) if self.searches:
                self.situation.search.looks.not_seen(place, why)
            case PutDown(place):
                self.situation.hand.unplaced[place] = why

    def cancel(self, request: int) -> None:
        """Cancel the goal, so that the robot brakes."""
        self.context.robot.cancel(request)


def _in_words(goal: Goal) -> str:
    match goal:
        case Pick(detection):
            return detection.label
        case Halt():
            return ""
        case _:
            return goal.place
