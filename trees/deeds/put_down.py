"""Put down what is in the hand: where the robot was sent, near the person, or where they say."""

from collections.abc import Iterable, Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types.commands import HELD, CommandKind
from executive.types.home import DELIVERY, HAND, SOMETHING
from executive.types.outcome import Outcome, TaskOutcome
from trees.context import MissionContext
from trees.deeds.deed import Conclude, Deed, asked_to
from trees.driving import DriveToSurface
from trees.handling import PutDownThere
from trees.held import HoldSurface, each_untried
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import AskWhereToPut, Report

NEAR = 3
"""How many pieces of furniture near the person are tried before the person is asked."""


class PutDown(Deed):
    """As in "Put it down"."""

    kind = CommandKind.PUT_DOWN

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """Empty the hand; nothing needs to be searched."""
        yield sequence(
            "put down",
            asked_to(context, self.kind),
            empty_hand(context),
            Conclude("done", context),
        )

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """It is on some furniture."""
        return whereabouts not in (HAND, "")


def empty_hand(context: MissionContext) -> Behaviour:
    """Put down what is in the hand as the person asks: where they sent the robot, or near them."""
    situation = context.situation

    def sent_to() -> Iterator[str]:
        if was_sent_here(context):
            yield situation.dialogue.at

    def choose(place: str) -> None:
        situation.hand.surface = place

    return sequence(
        "empty the hand",
        HoldsWhatIsMeant("holds it", context),
        fallback(
            "put it down",
            FirstOf("where it was sent", sent_to, go_and_put(context), choose=choose),
            put_down_somewhere(context, "by the person", DELIVERY),
            StillHolds("still in my hand", context),
        ),
        Report("report", context, "I put {the_object} {put}."),
    )


def was_sent_here(context: MissionContext) -> bool:
    """Whether the robot is at furniture to which it was just told to go.

    The last task of this mission counts, or else the last one of the request before.
    """
    situation, at = context.situation, context.situation.dialogue.at
    before = situation.dialogue.spoken
    if last := situation.agenda.ended[-1:]:
        asked, goals = last[0].kind, last[0].goals
    elif before.request:
        asked = before.request.tasks[-1].verb
        goals = context.knowledge.places_named(before.place)
    else:
        return False
    return asked == CommandKind.GO and at in goals and context.knowledge.has_place(at)


def put_down_somewhere(context: MissionContext, name: str, *first: str) -> Behaviour:
    """Put the held thing down; writes hand.put_at.

    The robot tries the places `first`, then those near the person, then it asks.
    """
    situation = context.situation

    def near() -> Iterator[str]:
        return each_untried([*first, *context.near_person[:NEAR]], lambda: situation.hand.surface)

    def choose(place: str) -> None:
        situation.hand.surface = place

    return fallback(
        name,
        FirstOf(
            "near the person",
            near,
            go_and_put(context, HoldSurface("choice", context)),
            choose=choose,
        ),
        sequence(
            "where the person says",
            Check("still in my hand", context, lambda: situation.hand.in_hand is not None),
            Check("person may help", context, lambda: not situation.dialogue.no_help),
            AskWhereToPut("ask where to put it", context),
            FirstOf("there", lambda: situation.hand.surfaces, go_and_put(context), choose=choose),
        ),
        NotPutDown("no room", context),
    )


def go_and_put(context: MissionContext, *before: Behaviour) -> Behaviour:
    """Take the thing to the furniture hand.surface and put it down.

    The steps `before` run first, and may choose other furniture.
    """
    return sequence(
        "go and put",
        Check("still in my hand", context, lambda: context.situation.hand.in_hand is not None),
        *before,
        DriveToSurface("drive", context),
        PutDownThere("put down", context),
    )


class NotPutDown(Step):
    """Says where there was no room, and why the person could not help; always fails."""

    def update(self) -> Status:
        """Say where; if the hand is empty or no place has failed, give the reason from before."""
        tried, silence = (
            self.situation.hand.not_put_down(self.context.say),
            self.situation.dialogue.no_help,
        )
        if self.situation.hand.in_hand is None or not tried:
            return self.fail(self.why_before())
        return self.fail(f"{tried}, and {silence}" if silence else tried)


class HoldsWhatIsMeant(Step):
    """Succeeds if the thing that is to be put down is in the hand.

    Reads hand.in_hand and request.command; writes request.object.
    """

    def update(self) -> Status:
        """Take what is in the hand; if the words name a thing, it must be that one."""
        held, target = self.situation.hand.in_hand, self.situation.request.asked_for.target
        if held is None:
            return self.fail("my hand is empty")
        named = self.context.knowledge.objects_named(target)
        if target != HELD and held not in (SOMETHING, *named):
            holds = f"my hand holds {self.context.say.the(held)}"
            return self.fail(f"{holds}, not the {self.context.as_said(target)}")
        self.situation.request.object = held
        return self.succeed(held)


class StillHolds(Step):
    """Says why the thing was not put down, and whether it is still in the hand; always fails."""

    def update(self) -> Status:
        """Join the clauses; a thing that fell, or was released, is not in the hand any more."""
        held, why = self.situation.hand.in_hand, self.why_before()
        if held:
            return self.fail(f"{why}; I still hold {self.context.say.the(held)}")
        if self.situation.hand.lost:
            return self.fail(why)
        name = self.situation.request.object or SOMETHING
        return self.fail(f"{why}; {self.context.say.are(name)} not in my hand any more")
