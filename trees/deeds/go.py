"""Go somewhere: to furniture, into a room, to the person."""

from collections.abc import Iterable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Activity
from executive.types.commands import CommandKind
from executive.types.home import PERSON
from executive.types.outcome import Outcome, TaskOutcome
from executive.types.results import Result, Succeeded
from trees.context import MissionContext
from trees.deeds.deed import Conclude, Deed, asked_to
from trees.driving import DriveToGoal
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import Report
from trees.places import destination


class Go(Deed):
    """As in "Go to the kitchen", "Come here"."""

    kind = CommandKind.GO

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """Drive to the place; for a room, to any furniture in it."""
        request = context.situation.request

        def choose(place: str) -> None:
            request.goal = place

        yield sequence(
            "go",
            asked_to(context, self.kind),
            destination(context),
            fallback(
                "get there",
                FirstOf("there", lambda: request.goals, GoThere("drive", context), choose=choose),
                NotThere("not there", context),
            ),
            fallback(
                "say so",
                sequence(
                    "with the person",
                    Check("by the person", context, lambda: request.goal == PERSON),
                    Report("report", context, "Here I am."),
                ),
                Report("report", context, "I am at {goal}."),
            ),
            Conclude("done", context),
        )

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """Judged by what the robot tells: the true places of things do not say where it is."""
        return outcome.goals == (PERSON,) or outcome.visited[-1:] in [(g,) for g in outcome.goals]


class GoThere(DriveToGoal):
    """Drives to the current goal, and counts it as visited.

    Reads request.goal; writes search.looks.
    """

    activity = Activity.DRIVING

    def ended(self, result: Result) -> Status:
        """Count the place if it was reached."""
        place = self.situation.request.goal
        if isinstance(result, Succeeded) and place != PERSON:
            self.situation.search.looks.reached(place)
        return super().ended(result)

    def note_failure(self, why: str) -> None:
        """Note that the place was not reached, and nothing about the hand."""
        self.situation.search.looks.not_reached(self.situation.request.goal, why)


class NotThere(Step):
    """Says which places could not be reached, and why; always fails.

    Reads search.looks.
    """

    def update(self) -> Status:
        """Sum up the places that were tried."""
        return self.fail(self.situation.search.so_far(None, self.context.say))
