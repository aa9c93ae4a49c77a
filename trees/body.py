"""The base of all actions of body and eyes: a goal, and what its failure means.

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
    """Something that the robot does with its body or its eyes.

    All failures and timeouts pass through here, so they are noted in one place.
    """

    def __init__(self, name: str, context: MissionContext) -> None:
        """The action may take as long as the parameters allow."""
        super().__init__(name, context, context.parameters.action_s)

    @abstractmethod
    def attempt(self) -> str:
        """What is attempted, as an infinitive."""

    @abstractmethod
    def note_failure(self, why: str) -> None:
        """Note what cannot be known or done because this failed."""

    def failed(self, result: Result) -> Status:
        """Fail with the reason that the robot gives."""
        why = self.why(result)
        self.note_failure(why)
        return self.fail(f"I could not {self.attempt()}: {why}" if why == UNSAID else why)

    def why(self, result: Result) -> str:
        """Why it failed; names of things and places, as robots use them, are put into words."""
        return self.context.say.in_words(why_of(result))

    def out_of_time(self) -> Status:
        """Fail because it took too long."""
        why = f"it took longer than {self._patience_s:g} s"
        self.note_failure(why)
        return self.fail(f"I could not {self.attempt()}: {why}")


class RobotAction(BodyAction):
    """Sends one goal to the robot.

    Writes ending.restless; when driving, dialogue.at, dialogue.stands and dialogue.heads_for;
    hand.lost if the robot lost the held thing; on failure, search.looks or hand.unplaced.
    """

    searches = False
    """Whether this is part of a search, so that a failure leaves a place unseen."""

    def __init__(self, name: str, context: MissionContext) -> None:
        """There is no goal yet."""
        super().__init__(name, context)
        self._goal: Goal = Halt()

    @abstractmethod
    def goal(self) -> Goal:
        """The goal to send."""

    def progress(self) -> str:
        """What to tell the person at the start; empty if there is nothing new to tell."""
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
        """Succeed if the robot did; else note whether it lost what it held."""
        self.situation.ending.restless = not isinstance(result, Succeeded)
        if isinstance(result, Succeeded):
            if isinstance(self._goal, DriveTo):
                self.situation.dialogue.at = self.situation.dialogue.stands = self._goal.place
            return Status.SUCCESS
        if isinstance(result, Failed) and result.lost:
            self.situation.hand.lost, self.situation.hand.in_hand = self.why(result), None
        return self.failed(result)

    def doing(self) -> str:
        """According to the goal."""
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
        """According to the goal."""
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
        """Note that a place was not reached or seen, or that the thing could not be put there."""
        match self._goal:
            case DriveTo(place) if self.searches:
                self.situation.search.looks.not_reached(place, why)
            case LookAt(place) if self.searches:
                self.situation.search.looks.not_seen(place, why)
            case PutDown(place):
                self.situation.hand.unplaced[place] = why

    def cancel(self, request: int) -> None:
        """Cancel the goal, so that the robot stops."""
        self.context.robot.cancel(request)


def _in_words(goal: Goal) -> str:
    match goal:
        case Pick(detection):
            return detection.label
        case Halt():
            return ""
        case _:
            return goal.place
