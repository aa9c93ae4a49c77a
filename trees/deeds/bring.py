"""Bring a thing: carry it to the delivery table and put it down, there or on other furniture."""

from collections.abc import Iterable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types.commands import CommandKind
from executive.types.home import DELIVERY, FLOOR
from executive.types.outcome import Outcome, TaskOutcome
from trees.context import MissionContext
from trees.deeds.deed import Deed, asked_to, found_at_a_place
from trees.deeds.fall import SayItFell, pick_up_again
from trees.deeds.put_down import put_down_somewhere
from trees.driving import DriveBack
from trees.handling import PutDownAt
from trees.nodes import Check, Step, fallback, sequence
from trees.person import Report


class Bring(Deed):
    """As in "Bring me the mug"."""

    kind = CommandKind.BRING
    did = "brought"

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """Report that it is on the delivery table already; else bring it."""
        situation = context.situation
        yield sequence(
            "is there already",
            asked_to(context, self.kind),
            Check("at the delivery place", context, lambda: situation.search.is_delivered),
            Report("report", context, "{The_object} {is_} here already, on the delivery table."),
        )
        yield sequence(
            "bring",
            asked_to(context, self.kind),
            deliver(context),
            ThereIndeed("there indeed", context),
            say_where(context),
        )

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """It is on the delivery table."""
        return whereabouts == DELIVERY


class ThereIndeed(Step):
    """Succeeds if the thing was put down on the delivery table; else says where it is, and why.

    Reads hand.put_at and hand.unplaced.
    """

    def update(self) -> Status:
        """Fail if it stands elsewhere: then it was not brought."""
        hand, say = self.situation.hand, self.context.say
        if hand.put_at == DELIVERY:
            return self.succeed()
        name, why = self.situation.request.thing, hand.unplaced.get(DELIVERY, "")
        there = f"I could not put {say.it(name)} {say.at(DELIVERY)}"
        return self.fail(f"I put {say.the(name)} {say.at(hand.put_at)}; {there}: {why}")


def say_where(context: MissionContext) -> Behaviour:
    """Report that the thing is here, and where it was."""
    return fallback(
        "say so",
        sequence(
            "from there",
            found_at_a_place(context),
            Report("report", context, "Here {is_} {the_object} from {place}."),
        ),
        Report("report", context, "Here {is_} {the_object}."),
    )


def deliver(context: MissionContext) -> Behaviour:
    """Carry the thing and put it down; if that fails there, on other furniture.

    If it falls on the way, or when it is put down, it is picked up again, once each.
    """
    return sequence(
        "deliver",
        fallback(
            "bring it there",
            DriveBack("carry", context, DELIVERY),
            sequence(
                "after a fall",
                pick_up_again(context, FLOOR),
                DriveBack("carry", context, DELIVERY),
            ),
            SayItFell("it fell", context),
        ),
        fallback(
            "leave it there",
            PutDownAt("put down", context, DELIVERY),
            sequence(
                "after a fall",
                pick_up_again(context, DELIVERY, FLOOR),
                PutDownAt("put down", context, DELIVERY),
            ),
            put_down_somewhere(context, "on other furniture"),
            SayItFell("it fell", context),
        ),
    )
