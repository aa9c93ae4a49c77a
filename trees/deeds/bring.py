"""Bring a thing: carry it to the delivery table and put it down, there or on other furniture."""

from collections.abc import Iterable, Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import DELIVERY, FLOOR, CommandKind, Outcome
from trees.context import MissionContext
from trees.deeds.deed import Deed, asked_to, found_at_a_place
from trees.deeds.put_down import put_down_somewhere
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import Report, the
from trees.robot import DriveBack, LookForLost, PickUp, PutDownAt, SeeLost


class Bring(Deed):
    """As in "Bring me the mug"."""

    kind = CommandKind.BRING

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """It may be on the delivery table already."""
        situation = context.situation
        yield sequence(
            "is there already",
            asked_to(context, self.kind),
            Check("at the delivery place", context, lambda: situation.search.is_delivered),
            Report("report", context, "The {object} is here already, on the delivery table."),
        )
        yield sequence("bring", asked_to(context, self.kind), deliver(context), say_where(context))

    def is_true(self, outcome: Outcome, whereabouts: str) -> bool:
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
                "I put the {object} on {surface}; I could not put it on the delivery table: {why}.",
            ),
        ),
        sequence(
            "from there",
            found_at_a_place(context),
            Report("report", context, "Here is the {object} from {place}."),
        ),
        Report("report", context, "Here is the {object}."),
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


def pick_up_again(context: MissionContext, *spots: str) -> Behaviour:
    """Look for what fell from the hand at these spots, and pick it up."""
    situation = context.situation

    def views() -> Iterator[tuple[str, int]]:
        return ((spot, view) for spot in spots for view in range(context.robot.views(spot)))

    def choose(look: tuple[str, int]) -> None:
        situation.hand.spot, situation.search.view = look

    return sequence(
        "pick it up again",
        Check("it fell", context, lambda: bool(situation.hand.lost)),
        FirstOf(
            "look around",
            views,
            choose,
            sequence("glance", LookForLost("aim", context), SeeLost("see", context)),
        ),
        PickUp("pick", context),
    )


class SayItFell(Step):
    """Says why it was not brought, and whether it fell or is still in the hand; always fails."""

    def update(self) -> Status:
        """Put the clauses together, if there are two."""
        held, lost, why = (
            self.situation.hand.in_hand,
            self.situation.hand.lost,
            self.why_before(),
        )
        if lost and lost != why:
            return self.fail(f"{lost}, and {why}")
        if held:
            return self.fail(f"{why}; I still hold {the(held)}")
        gone = f"the {self.situation.request.object} is not in my hand any more"
        return self.fail(why if lost else f"{why}; {gone}")
