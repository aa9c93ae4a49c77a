"""Find a thing: come back, and tell where it is."""

from collections.abc import Iterable

from py_trees.behaviour import Behaviour

from executive.types.commands import CommandKind
from executive.types.home import HAND
from executive.types.outcome import Outcome, TaskOutcome
from trees.context import MissionContext
from trees.deeds.deed import Deed, asked_to, found_at_a_place
from trees.driving import back_to_the_person
from trees.nodes import Check, sequence
from trees.person import Report


class Find(Deed):
    """As in "Where is the mug?"."""

    kind = CommandKind.FIND
    did = "found"

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """Come back and tell where it is; if there is more to do, tell it on the way."""
        agenda = context.situation.agenda
        yield sequence(
            "find on the way",
            asked_to(context, self.kind),
            found_at_a_place(context),
            Check("there is more to do", context, lambda: agenda.goes_on),
            Report("report", context, "{The_object} {is_} {at}."),
        )
        yield sequence(
            "find",
            asked_to(context, self.kind),
            found_at_a_place(context),
            back_to_the_person(context),
            Report("report", context, "{The_object} {is_} {at}."),
        )

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """True if it is on the furniture that the robot names and went to, or in its hand."""
        if outcome.location is None:
            return whereabouts == HAND
        return whereabouts == outcome.location and whereabouts in outcome.visited

    def how_far(self, context: MissionContext, why: str) -> str:
        """Where the thing is, even if the robot cannot come back: the person wants to know it."""
        found, say = context.situation.search.found, context.say
        if not found:
            return why
        where = f"{say.are(context.situation.request.object or '')} {say.at_in_full(found.place)}"
        return f"{where}, but {why}"
