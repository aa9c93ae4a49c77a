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
        """Come back and report; with more to do, report at once and go on."""
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
        """The thing is in the hand; or on the furniture that was named, and the robot was there."""
        if outcome.location is None:
            return whereabouts == HAND
        return whereabouts == outcome.location and whereabouts in outcome.visited

    def how_far(self, context: MissionContext, why: str) -> str:
        """Say where the thing is, also if the robot could not come back."""
        found, say = context.situation.search.found, context.say
        if not found:
            return why
        where = f"{say.are(context.situation.request.thing)} {say.at_in_full(found.place)}"
        return f"{where}, but {why}"
