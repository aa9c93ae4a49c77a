"""What to do if the thing falls from the hand: pick it up again if possible, else tell."""

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from trees.context import MissionContext
from trees.handling import PickUp
from trees.looking import LookForLost, SeeLost
from trees.nodes import Check, FirstOf, Step, sequence


def pick_up_again(context: MissionContext, *spots: str, at_goal: bool = False) -> Behaviour:
    """Look for the fallen thing at these spots (`at_goal`: first at the goal), and pick it up."""
    situation = context.situation

    def views() -> Iterator[tuple[str, int]]:
        goal = (situation.request.goal,) if at_goal else ()
        return ((s, view) for s in (*goal, *spots) for view in range(context.robot.views(s)))

    def choose(look: tuple[str, int]) -> None:
        situation.hand.spot, situation.search.view = look

    return sequence(
        "pick it up again",
        Check("it fell", context, lambda: bool(situation.hand.lost)),
        FirstOf(
            "look around",
            views,
            sequence("glance", LookForLost("aim", context), SeeLost("see", context)),
            choose=choose,
        ),
        PickUp("pick", context),
    )


class SayItFell(Step):
    """Says why it was not brought, and whether it fell or is still in the hand; always fails."""

    def update(self) -> Status:
        """Join the clauses."""
        held, lost, why = (
            self.situation.hand.in_hand,
            self.situation.hand.lost,
            self.why_before(),
        )
        if lost and lost != why:
            return self.fail(f"{lost}, and {why}")
        if held:
            return self.fail(f"{why}; I still hold {self.context.say.the(held)}")
        gone = (
            f"{self.context.say.are(self.situation.request.object or '')} not in my hand any more"
        )
        return self.fail(why if lost else f"{why}; {gone}")
