"""What there is to know of a verb: a template for one's own, in `docs/examples/own_verb.md`."""

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
    """How the robot does what a verb asks for. It holds nothing: one serves all missions."""

    kind: CommandKind
    did: str = "did"
    """As it is told when it was done to several things: "I brought two of three"."""

    @abstractmethod
    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """The subtrees that do it, the best first; each begins with `asked_to`.

        The thing was found by then, if the verb searches (`situation.search.found`; None if it was
        in the hand all along), and is in the hand, if the verb grasps. One that succeeds has said
        so; if the verb does not search, it ends with `Conclude`, too.
        """

    @abstractmethod
    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """Whether it was done, where the robot says so: for campaigns, which know the truth.

        Args:
            outcome: what the robot says.
            whereabouts: the furniture that the thing is on in the end, `HAND`, or nothing.
        """

    def is_true_of(self, outcome: Outcome | TaskOutcome, where: Callable[[str], str]) -> bool:
        """The same, for deeds about more than one thing: `where` tells the `whereabouts` of any."""
        return self.is_true(outcome, where(outcome.object or ""))

    def how_far(self, context: MissionContext, why: str) -> str:
        """What came of it although not all was done, which `why` tells; as a clause, too."""
        return why


class Conclude(Step):
    """Marks the mission as done."""

    def update(self) -> Status:
        """Done."""
        self.situation.ending.status = MissionStatus.DONE
        return Status.SUCCESS


def asked_to(context: MissionContext, kind: CommandKind) -> Check:
    """Whether this kind of deed was asked for."""
    return Check(f"asked to {kind}", context, lambda: context.situation.request.asks_to(kind))


def found_at_a_place(context: MissionContext) -> Check:
    """Whether it was found, and not in the hand all along."""
    return Check("found at a place", context, lambda: context.situation.search.found is not None)


def meaning(situation: Situation) -> Meaning:
    """What the verb means that was asked for."""
    return situation.request.asked_for.kind.means
