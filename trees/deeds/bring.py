"""Bring a thing: carry it to the delivery table and put it down, there or on other furniture."""

from collections.abc import Iterable

from py_trees.behaviour import Behaviour

from executive.types import DELIVERY, FLOOR, CommandKind, Outcome, TaskOutcome
from trees.context import MissionContext
from trees.deeds.deed import Deed, asked_to, found_at_a_place
from trees.deeds.fall import SayItFell, pick_up_again
from trees.deeds.put_down import put_down_somewhere
from trees.nodes import Check, fallback, sequence
from trees.person import Report
from trees.robot import DriveBack, PutDownAt


class Bring(Deed):
    """As in "Bring me the mug"."""

    kind = CommandKind.BRING
    did = "brought"

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """It may be on the delivery table already."""
        situation = context.situation
        yield sequence(
            "is there already",
            asked_to(context, self.kind),
            Check("at the delivery place", context, lambda: situation.search.is_delivered),
            Report("report", context, "{The_object} {is_} here already, on the delivery table."),
        )
        yield sequence("bring", asked_to(context, self.kind), deliver(context), say_where(context))

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """It is on the delivery table."""
        return whereabouts == DELIVERY


def say_where(context: MissionContext) -> Behaviour:
    """Tell where it is now, if that is not the delivery table, else where it was."""
    return fallback(
        "say so",
        sequence(
            "elsewhere",
            Check("on other furniture", context, lambda: context.situation.hand.put_at != DELIVERY),
            Report(
                "report",
                context,
                "I put {the_object} {put}; I could not put {it} on the delivery table: {why}.",
            ),
        ),
        sequence(
            "from there",
            found_at_a_place(context),
            Report("report", context, "Here {is_} {the_object} from {place}."),
        ),
        Report("report", context, "Here {is_} {the_object}."),
    )


def deliver(context: MissionContext) -> Behaviour:
    """Carry it and put it down; what falls on the way, or falls over there, is picked up once."""
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
