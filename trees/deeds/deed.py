"""The interface of a verb; `docs/examples/own_verb.md` has a template for your own."""

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
    """How the robot does what a verb asks for. Has no state: one object serves all missions."""

    kind: CommandKind
    did: str = "did"
    """The verb in reports about several things: "I brought two of three"."""

    @abstractmethod
    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """The subtrees that do it, the best first; each begins with `asked_to`.

        If the verb searches, it was found (`situation.search.found`; None if it was in the hand
        from the start). If the verb grasps, the thing is in the hand. A subtree that succeeds has
        told the person; if the verb does not search, the subtree also ends with `Conclude`.
        """

    @abstractmethod
    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """Whether it was really done, if the robot says so: for campaigns, which know the truth.

        Args:
            outcome: what the robot says.
            whereabouts: the furniture that the thing is on in the end, `HAND`, or empty.
        """

    def is_true_of(self, outcome: Outcome | TaskOutcome, where: Callable[[str], str]) -> bool:
        """The same for deeds about several things: `where` gives the `whereabouts` of each."""
        return self.is_true(outcome, where(outcome.object or ""))

    def how_far(self, context: MissionContext, why: str) -> str:
        """What to tell if not all was done, as a clause; by default only the reason `why`."""
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
    """Whether the thing was found at a place, and was not in the hand from the start."""
    return Check("found at a place", context, lambda: context.situation.search.found is not None)


def meaning(situation: Situation) -> Meaning:
    """What the verb of the current command means."""
    assert situation.request.command
    return situation.request.command.kind.means
