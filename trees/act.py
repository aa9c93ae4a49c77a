"""Do what was asked with the thing that was found; `deeds/` has a file for each verb."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from trees.context import MissionContext
from trees.deeds import DEEDS, deed_of
from trees.deeds.deed import meaning
from trees.nodes import Check, Step, fallback, sequence
from trees.person import Report


def act(context: MissionContext) -> Behaviour:
    """Do the deed with the thing: it was found, and is in the hand if the verb needs that."""
    situation = context.situation
    with_it = [deed for deed in DEEDS if deed.kind.means.searches]
    return fallback(
        "act",
        *(way for deed in with_it for way in deed.ways(context)),
        sequence(
            "have it",
            Check(
                "had it before", context, lambda: situation.has_it and not situation.search.found
            ),
            Check("not asked to bring", context, lambda: not meaning(situation).carries),
            Report("report", context, "I hold {the_object}."),
        ),
        SayHowFar("not all of it", context),
    )


def without_a_search(context: MissionContext) -> list[Behaviour]:
    """The deeds that need no search, such as "go" and "put down"."""
    others = [deed for deed in DEEDS if not deed.kind.means.searches]
    return [way for deed in others for way in deed.ways(context)]


class SayHowFar(Step):
    """Says how far the task got although not all of it was done; always fails."""

    def update(self) -> Status:
        """Let the deed choose what is worth telling."""
        assert self.situation.request.command
        deed, why = deed_of(self.situation.request.command.kind), self.why_before()
        return self.fail(deed.how_far(self.context, why))
