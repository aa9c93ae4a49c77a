"""The hand holds one thing at a time: is it free for another, and may it be emptied first."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import DELIVERY
from trees.context import MissionContext
from trees.deeds.deed import meaning
from trees.deeds.put_down import put_down_somewhere
from trees.nodes import Step, fallback, sequence
from trees.person import AskToPutDown, full_hand, the


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


class HandIsFree(Step):
    """Succeeds if the hand is free for what is asked: it holds one thing at a time."""

    def update(self) -> Status:
        """Fail if another thing than the one that is asked for is in it."""
        held = self.situation.hand.in_hand
        if held in (None, self.situation.request.object) or not meaning(self.situation).grasps:
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


def arm_for_it(context: MissionContext) -> tuple[Behaviour, ...]:
    """What declines at once what a robot without an arm cannot do; nothing if it has one."""
    return () if context.has_arm else (NeedsNoArm("needs no arm", context),)


class NeedsNoArm(Step):
    """Fails if what was asked for takes an arm."""

    def update(self) -> Status:
        """Looking and going take none."""
        if meaning(self.situation).grasps:
            return self.fail("I have no arm: I can find things, but not take them")
        return Status.SUCCESS
