"""The hand holds one thing at a time: what is in it is put away before another one is taken."""

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
    """Go on if the hand is free for what is asked; else put away what it holds, and say so."""
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
    """Put what is held where it was taken from, the surface at hand."""
    return sequence(
        "put it back",
        SayWhatFirst("say so", context, "I put {held} back {surface} first."),
        go_and_put(context),
    )


class HandIsFree(Step):
    """Succeeds if the hand is free for what is asked: it holds one thing at a time."""

    def update(self) -> Status:
        """Fail if another thing than the one that is asked for is in it."""
        held = self.situation.hand.in_hand
        if held in (None, self.situation.request.object) or not meaning(self.situation).grasps:
            return Status.SUCCESS
        return self.fail(f"my hand holds {self.context.say.the(held)}")


class SayWhatFirst(Step):
    """Tells what becomes of what is in the hand.

    Reads hand.in_hand and hand.surface.
    """

    def __init__(self, name: str, context: MissionContext, text: str) -> None:
        """`text` may use {held} and {surface}, with its preposition."""
        super().__init__(name, context)
        self._text = text

    def update(self) -> Status:
        """Say it; what has fallen meanwhile cannot be put anywhere."""
        hand = self.situation.hand
        if hand.in_hand is None:
            return self.fail(hand.lost)
        say = self.context.say
        said = self._text.format(held=say.the(hand.in_hand), surface=say.at(hand.surface))
        tell(self.context, said)
        return self.succeed(said)


class FellOut(Step):
    """Succeeds if what was held fell, and says so: the hand is free by that.

    Reads hand.in_hand and hand.lost.
    """

    def update(self) -> Status:
        """Nobody wants it now."""
        if self.situation.hand.in_hand is not None:
            return Status.FAILURE
        tell(self.context, sentence(self.situation.hand.lost or "It fell from my hand"))
        return self.succeed()


class HandStaysFull(Step):
    """Says why the hand is not free; always fails."""

    def update(self) -> Status:
        """There was no room for what it holds."""
        held, why = self.situation.hand.in_hand or "", self.why_before()
        return self.fail(f"{why}; I still hold {self.context.say.the(held)}")


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
