"""Leaves that drive the robot: to where a thing may be, to where it goes, and back."""

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
    """Drives to the place where the thing may be.

    Reads search.candidate; writes dialogue.away.
    """

    activity = Activity.DRIVING
    searches = True

    def goal(self) -> Goal:
        """Drive to the candidate."""
        self.situation.dialogue.away = True
        return DriveTo(self.situation.search.place)


class Visit(DriveToCandidate):
    """Drives to a candidate, which then counts as visited.

    If an experimenter sends the robot to another place meanwhile, it drives there instead.

    Reads search.candidate, search.sent_to and search.looks; writes search.looks.
    """

    def start(self) -> int:
        """Take the place where an experimenter sends the robot, if any."""
        search = self.situation.search
        if search.sent_to and is_here(self.context, search.sent_to):
            search.candidate = Candidate(search.sent_to, EXPERIMENTER)
        search.sent_to = ""
        return super().start()

    def update(self) -> Status:
        """Start again if an experimenter sends the robot elsewhere on the way."""
        sent_to, request = self.situation.search.sent_to, self._request
        if sent_to and is_here(self.context, sent_to) and request is not None:
            self._wait_no_more(request)
            self.cancel(request)
            return self.start_again()
        return super().update()

    def progress(self) -> str:
        """Say why it goes on to the next place; the first one was announced."""
        return on_to_the_next(self.context)

    def ended(self, result: Result) -> Status:
        """Count the place as visited, if it was reached."""
        if isinstance(result, Succeeded):
            self.situation.search.looks.reached(self.situation.search.place)
        return super().ended(result)


class DriveBack(RobotAction):
    """Drives back to the person or to the delivery table: `person` or `delivery`.

    Writes dialogue.away.
    """

    activity = Activity.DRIVING

    def __init__(self, name: str, context: MissionContext, place: str) -> None:
        """Name the place."""
        super().__init__(name, context)
        self._place = place

    def progress(self) -> str:
        """Say that it comes back, or with what."""
        return on_the_way(self.context, self._place)

    def goal(self) -> Goal:
        """Drive there."""
        return DriveTo(self._place)

    def ended(self, result: Result) -> Status:
        """Note whether the robot is back."""
        self.situation.dialogue.away = not isinstance(result, Succeeded)
        return super().ended(result)


def back_to_the_person(context: MissionContext) -> Behaviour:
    """Come back; try twice, because what was in the way may be gone a moment later."""
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
        """Note why the thing was not put down there."""
        self.situation.hand.unplaced[self.situation.hand.surface] = why


class DriveToGoal(RobotAction):
    """Drives to the goal of the command, alone or with the thing.

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
        """Note that the robot is with the person, if that was the goal."""
        if isinstance(result, Succeeded) and self.situation.request.goal == PERSON:
            self.situation.dialogue.away = False
        return super().ended(result)

    def note_failure(self, why: str) -> None:
        """Note why the held thing was not put down there."""
        if self.situation.hand.in_hand:
            place = self.situation.request.goal
            there = self.context.say.the(place)
            self.situation.hand.unplaced[place] = f"I could not get to {there}: {why}"
