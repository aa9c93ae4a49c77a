"""Take a thing: pick it up and hold it."""

from collections.abc import Iterable

from py_trees.behaviour import Behaviour

from executive.types.commands import CommandKind
from executive.types.home import HAND
from executive.types.outcome import Outcome, TaskOutcome
from trees.context import MissionContext
from trees.deeds.deed import Deed, asked_to, found_at_a_place
from trees.nodes import Check, sequence
from trees.person import Report


class Take(Deed):
    """As in "Take the mug"."""

    kind = CommandKind.TAKE
    did = "took"

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """Report it; the thing is in the hand by now."""
        yield sequence(
            "take",
            asked_to(context, self.kind),
            found_at_a_place(context),
            Check("in my hand", context, lambda: context.situation.has_it),
            Report("report", context, "I took {the_object} from {place} and hold {it}."),
        )

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """It is in the hand."""
        return whereabouts == HAND

    def how_far(self, context: MissionContext, why: str) -> str:
        """If it has fallen meanwhile, say that it is not in the hand any more."""
        if context.situation.has_it:
            return why
        name = context.situation.request.thing
        return f"{context.say.are(name)} not in my hand any more"
