"""The hand holds one thing at a time: the robot puts it away before it takes another one."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types.home import DELIVERY
from trees.context import MissionContext
from trees.deeds.deed import meaning
from trees.deeds.put_down import go_and_put, put_down_somewhere
from trees.nodes import FirstOf, Step, fallback, sequence
from trees.places import taken_from
from trees.telling import sentence, tell


def hand_is_free(context: MissionContext) -> Behaviour:
    """Succeed if the hand is free for the task; else put away what it holds, and tell it."""
    hand = context.situation.hand

    def back() -> tuple[str, ...]:
        return taken_from(context, hand.in_hand)[:1]

    def choose(place: str) -> None:
        hand.surface = place

    return fallback(
        "hand is free",
        HandIsFree("nothing else is in it", context),
        fallback(
            "make room",
            FirstOf("back where it was", back, put_back_first(context), choose=choose),
            sequence(
                "by the person",
                SayWhatFirst("say so", context, "I put {held} down by you first."),
                put_down_somewhere(context, "put it down", DELIVERY),
            ),
        ),
        FellOut("it fell", context),
        HandStaysFull("not free", context),
    )


def put_back_first(context: MissionContext) -> Behaviour:
    """Put the held thing back where it was taken from (hand.surface)."""
    return sequence(
        "put it back",
        SayWhatFirst("say so", context, "I put {held} back {surface} first."),
        go_and_put(context),
    )


class HandIsFree(Step):
    """Succeeds if the hand is free for the task.

    Reads hand.in_hand, request.object and request.command.
    """

    def update(self) -> Status:
        """Fail if the task is to grasp a thing, and another one is in the hand."""
        held = self.situation.hand.in_hand
        if held in (None, self.situation.request.object) or not meaning(self.situation).grasps:
            return Status.SUCCESS
        return self.fail(f"my hand holds {self.context.say.the(held)}")


class SayWhatFirst(Step):
    """Tells where the robot puts what is in its hand.

    Reads hand.in_hand and hand.surface.
    """

    def __init__(self, name: str, context: MissionContext, text: str) -> None:
        """`text` may contain {held}, and {surface} with its preposition."""
        super().__init__(name, context)
        self._text = text

    def update(self) -> Status:
        """Tell it; fail if the thing has fallen meanwhile."""
        hand = self.situation.hand
        if hand.in_hand is None:
            return self.fail(hand.lost)
        say = self.context.say
        said = self._text.format(held=say.the(hand.in_hand), surface=say.at(hand.surface))
        tell(self.context, said)
        return self.succeed(said)


class FellOut(Step):
    """Succeeds if the held thing has fallen, and tells it: so the hand is free.

    Reads hand.in_hand and hand.lost.
    """

    def update(self) -> Status:
        """Tell it; nobody looks for the fallen thing now."""
        if self.situation.hand.in_hand is not None:
            return Status.FAILURE
        tell(self.context, sentence(self.situation.hand.lost or "It fell from my hand"))
        return self.succeed()


class HandStaysFull(Step):
    """Says why the hand is not free; always fails."""

    def update(self) -> Status:
        """Say why the thing was not put away."""
        held, why = self.situation.hand.in_hand or "", self.why_before()
        return self.fail(f"{why}; I still hold {self.context.say.the(held)}")


def arm_for_it(context: MissionContext) -> tuple[Behaviour, ...]:
    """A check that declines at once what a robot without an arm cannot do; none if it has one."""
    return () if context.has_arm else (NeedsNoArm("needs no arm", context),)


class NeedsNoArm(Step):
    """Fails if the task needs an arm."""

    def update(self) -> Status:
        """Fail if the task is to grasp a thing."""
        if meaning(self.situation).grasps:
            return self.fail("I have no arm: I can find things, but not take them")
        return Status.SUCCESS
