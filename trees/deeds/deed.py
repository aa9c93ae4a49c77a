"""What defines a verb; `docs/examples/own_verb.md` is a template for one of your own."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.situation import Situation
from executive.types.commands import CommandKind, Meaning
from executive.types.outcome import MissionStatus, Outcome, TaskOutcome
from trees.context import MissionContext
from trees.nodes import Check, Step


class Deed(ABC):
    """How the robot does what a verb asks for. It has no state, so that all missions share it."""

    kind: CommandKind
    did: str = "did"
    """The verb's past tense, to tell how many things it was done to: "I brought two of three"."""

    @abstractmethod
    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """The subtrees that do it, the best first; each begins with `asked_to`.

        If the verb searches, the thing was found by then (`situation.search.found`; None if it was
        already in the hand). If the verb grasps, it is in the hand. A subtree that succeeds must
        have told the person so; if the verb does not search, it must end with `Conclude`, too.
        """

    @abstractmethod
    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """Whether the deed was really done, if the robot says so: for campaigns.

        Args:
            outcome: what the robot says.
            whereabouts: where the thing really is in the end: furniture, `HAND`, or empty.
        """

    def is_true_of(self, outcome: Outcome | TaskOutcome, where: Callable[[str], str]) -> bool:
        """The same for deeds about several things; `where` tells the `whereabouts` of any thing."""
        return self.is_true(outcome, where(outcome.object or ""))

    def how_far(self, context: MissionContext, why: str) -> str:
        """What was done or found out although not all was done, as a clause; `why` says why not."""
        return why


class Conclude(Step):
    """Marks the mission as done."""

    def update(self) -> Status:
        """Set the status."""
        self.situation.ending.status = MissionStatus.DONE
        return Status.SUCCESS


def asked_to(context: MissionContext, kind: CommandKind) -> Check:
    """Whether the command is of this kind."""
    return Check(f"asked to {kind}", context, lambda: context.situation.request.asks_to(kind))


def found_at_a_place(context: MissionContext) -> Check:
    """Whether the thing was found at a place, and was not already in the hand."""
    return Check("found at a place", context, lambda: context.situation.search.found is not None)


def meaning(situation: Situation) -> Meaning:
    """The meaning of the command's verb."""
    return situation.request.asked_for.kind.means
