"""Leaves that drive the robot: to where a thing may be, to where it is to go, and back."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Activity
from executive.types.goals import DriveTo, Goal
from executive.types.home import PERSON
from executive.types.knowledge import Candidate
from executive.types.results import Result, Succeeded
from trees.body import RobotAction
from trees.context import MissionContext
from trees.nodes import fallback
from trees.progress import on_the_way, on_to_the_next
from trees.recall import is_here

EXPERIMENTER = "experimenter"
"""The source of a place to which an experimenter sends the robot."""


class DriveToCandidate(RobotAction):
    """Drives to the current candidate place.

    Reads search.candidate; writes dialogue.away.
    """

    activity = Activity.DRIVING
    searches = True

    def goal(self) -> Goal:
        """Drive to the candidate."""
        assert self.situation.search.candidate
        self.situation.dialogue.away = True
        return DriveTo(self.situation.search.candidate.place)


class Visit(DriveToCandidate):
    """Drives to a place for the first time; if it is reached, it counts as visited.

    If an experimenter sends the robot to another place meanwhile, it drives there instead.

    Reads search.candidate, search.sent_to and search.looks; writes search.looks.
    """

    def start(self) -> int:
        """Drive to the experimenter's place if there is one, else to the candidate."""
        search = self.situation.search
        if search.sent_to and is_here(self.context, search.sent_to):
            search.candidate = Candidate(search.sent_to, EXPERIMENTER)
        search.sent_to = ""
        return super().start()

    def update(self) -> Status:
        """Cancel and start again if the experimenter sends the robot elsewhere."""
        sent_to, request = self.situation.search.sent_to, self._request
        if sent_to and is_here(self.context, sent_to) and request is not None:
            self._wait_no_more(request)
            self.cancel(request)
            return self.start_again()
        return super().update()

    def progress(self) -> str:
        """For each place after the first, why the robot goes on; the first one was announced."""
        return on_to_the_next(self.context)

    def ended(self, result: Result) -> Status:
        """Count the place if it was reached."""
        assert self.situation.search.candidate
        if isinstance(result, Succeeded):
            self.situation.search.looks.reached(self.situation.search.candidate.place)
        return super().ended(result)


class DriveBack(RobotAction):
    """Drives to the person, or to the delivery table.

    Writes dialogue.away.
    """

    activity = Activity.DRIVING

    def __init__(self, name: str, context: MissionContext, place: str) -> None:
        """Name the place."""
        super().__init__(name, context)
        self._place = place

    def progress(self) -> str:
        """Say what the robot does next."""
        return on_the_way(self.context, self._place)

    def goal(self) -> Goal:
        """Drive there."""
        return DriveTo(self._place)

    def ended(self, result: Result) -> Status:
        """The robot is no longer away if it arrived."""
        self.situation.dialogue.away = not isinstance(result, Succeeded)
        return super().ended(result)


def back_to_the_person(context: MissionContext) -> Behaviour:
    """Drive to the person; try twice, because what was in the way may be gone a moment later."""
    return fallback(
        "back to the person",
        DriveBack("come back", context, PERSON),
        DriveBack("once more", context, PERSON),
    )


class DriveToSurface(RobotAction):
    """Drives to the furniture where the held thing may be put down.

    Reads hand.surface; writes dialogue.away and hand.unplaced.
    """

    activity = Activity.DRIVING

    def progress(self) -> str:
        """Say where the robot drives."""
        return on_the_way(self.context, self.situation.hand.surface)

    def goal(self) -> Goal:
        """Drive there, away from the person."""
        self.situation.dialogue.away = True
        return DriveTo(self.situation.hand.surface)

    def note_failure(self, why: str) -> None:
        """Note that the thing cannot be put down there."""
        self.situation.hand.unplaced[self.situation.hand.surface] = why


class DriveToGoal(RobotAction):
    """Drives to the goal of the command, for a thing or for the robot itself.

    Reads request.goal; writes dialogue.away, and hand.unplaced if something is in the hand.
    """

    activity = Activity.DRIVING

    def progress(self) -> str:
        """Say where the robot drives."""
        return on_the_way(self.context, self.situation.request.goal)

    def goal(self) -> Goal:
        """Drive there."""
        self.situation.dialogue.away = True
        return DriveTo(self.situation.request.goal)

    def ended(self, result: Result) -> Status:
        """If the goal is the person, the robot is no longer away."""
        if isinstance(result, Succeeded) and self.situation.request.goal == PERSON:
            self.situation.dialogue.away = False
        return super().ended(result)

    def note_failure(self, why: str) -> None:
        """Note that the held thing cannot be put down there."""
        if self.situation.hand.in_hand:
            place = self.situation.request.goal
            there = self.context.say.the(place)
            self.situation.hand.unplaced[place] = f"I could not get to {there}: {why}"
