"""The hand holds one thing at a time: is it free for another, and how it is emptied on request."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.put_down import HELD
from executive.types import DELIVERY, SOMETHING, CommandKind
from trees.context import MissionContext
from trees.nodes import Step, fallback, sequence
from trees.person import AskToPutDown, Report, full_hand, the
from trees.put_down import put_down_somewhere


def hand_is_free(context: MissionContext) -> Behaviour:
    """Go on if the hand is free for what is asked; else offer to empty it first."""
    return fallback(
        "hand is free",
        HandIsFree("nothing else is in it", context),
        sequence(
            "make room",
            AskToPutDown("ask to put it down", context),
            put_down_somewhere(context, "put it down", DELIVERY),
        ),
        HandStaysFull("not free", context),
    )


def empty_hand(context: MissionContext) -> Behaviour:
    """Put down what is in the hand, because the person says so."""
    return sequence(
        "empty the hand",
        HoldsWhatIsMeant("holds it", context),
        fallback(
            "put it down",
            put_down_somewhere(context, "by the person", DELIVERY),
            StillHolds("still in my hand", context),
        ),
        Report("report", context, "I put {the_object} on {surface}."),
    )


class HandIsFree(Step):
    """Succeeds if the hand is free for what is asked: it holds one thing at a time.

    Reads request.command and hand.in_hand.
    """

    def update(self) -> Status:
        """Fail if another thing than the one that is asked for is in it."""
        assert self.situation.request.command
        held = self.situation.hand.in_hand
        if (
            held in (None, self.situation.request.object)
            or self.situation.request.command.kind == CommandKind.FIND
        ):
            return Status.SUCCESS
        return self.fail(full_hand(held))


class HandStaysFull(Step):
    """Says why the hand is not free; always fails."""

    def update(self) -> Status:
        """There was no room for what it holds, or it may not be put down."""
        held, why = self.situation.hand.in_hand, self.why_before()
        if held is None:
            return self.fail(why)
        if self.situation.hand.unplaced:
            return self.fail(f"{why}; I still hold {the(held)}")
        return self.fail(full_hand(held))


class StillHolds(Step):
    """Says why the hand is not empty, and that it is not; always fails."""

    def update(self) -> Status:
        """What fell is no longer held; nor is what was let go of before it went wrong."""
        held, why = self.situation.hand.in_hand, self.why_before()
        if held:
            return self.fail(f"{why}; I still hold {the(held)}")
        if self.situation.hand.lost:
            return self.fail(why)
        return self.fail(
            f"{why}; {the(self.situation.request.object or SOMETHING)} is not in my hand any more"
        )


class HoldsWhatIsMeant(Step):
    """Succeeds if what is to be put down is in the hand.

    Reads request.command and hand.in_hand; writes request.object.
    """

    def update(self) -> Status:
        """Nobody need say the name of what is held; if they do, it has to be that."""
        assert self.situation.request.command
        held, target = self.situation.hand.in_hand, self.situation.request.command.target
        if held is None:
            return self.fail("my hand is empty")
        named = self.context.knowledge.objects_named(target)
        if target != HELD and held not in (SOMETHING, *named):
            return self.fail(f"my hand holds {the(held)}, not the {target}")
        self.situation.request.object = held
        return self.succeed(held)
