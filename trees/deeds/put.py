"""Put a thing where the person says: on that furniture or in that room; nowhere else counts."""

from collections.abc import Iterable, Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types.commands import CommandKind
from executive.types.home import FLOOR
from executive.types.outcome import Outcome, TaskOutcome
from trees.context import MissionContext
from trees.deeds.deed import Deed, asked_to
from trees.deeds.fall import pick_up_again
from trees.deeds.put_down import go_and_put
from trees.driving import DriveToGoal
from trees.handling import PutDownAtGoal
from trees.held import HoldGoal, each_untried
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import AskWhereToPut, Report


class Put(Deed):
    """As in "Put the mug on the desk", "Take the mug to the kitchen"."""

    kind = CommandKind.PUT
    did = "put"
    already = "{The_object} {is_} {at} already."
    report = "I put {the_object} {put}."

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """Report that it is there already; else put it there."""
        situation = context.situation

        def is_there() -> bool:
            found = situation.search.found
            at_goal = found is not None and found.place in situation.request.goals
            return at_goal and not situation.has_it

        yield sequence(
            f"{self.kind} already",
            asked_to(context, self.kind),
            Check("found at the goal", context, is_there),
            Report("report", context, self.already),
        )
        yield sequence(
            str(self.kind),
            asked_to(context, self.kind),
            put_at_goal(context),
            Report("report", context, self.report),
        )

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """It is on furniture that the goal names."""
        return whereabouts in outcome.goals


def put_at_goal(context: MissionContext) -> Behaviour:
    """Put the held thing down at one of the goals; writes hand.put_at.

    If no goal has room, the person may name another place. The thing is put there, and it still
    fails, because that is not what was asked for.
    """
    situation = context.situation

    def goals() -> Iterator[str]:
        return each_untried(situation.request.goals, lambda: situation.request.goal)

    def choose_goal(place: str) -> None:
        situation.request.goal = place

    def choose(place: str) -> None:
        situation.hand.surface = place

    holds = Check("still in my hand", context, lambda: situation.hand.in_hand is not None)
    return fallback(
        "put it there",
        FirstOf("where it is to go", goals, carry(context), choose=choose_goal),
        sequence(
            "elsewhere",
            holds,
            Check("person may help", context, lambda: not situation.dialogue.no_help),
            AskWhereToPut("ask where to put it", context),
            FirstOf("there", lambda: situation.hand.surfaces, go_and_put(context), choose=choose),
            PutElsewhere("put elsewhere", context),
        ),
        NotAtGoal("not there", context),
    )


def carry(context: MissionContext) -> Behaviour:
    """Take the thing to the chosen goal and put it down.

    If it falls on the way, or when it is put down, it is picked up again, once each.
    """
    hand = context.situation.hand

    def again(step: Behaviour, *, at_goal: bool) -> Behaviour:
        return FirstOf(
            "after a fall",
            lambda: [hand.lost] if hand.lost else [],
            sequence("once more", pick_up_again(context, FLOOR, at_goal=at_goal), step),
        )

    return sequence(
        "carry it there",
        Check("still in my hand", context, lambda: hand.in_hand is not None),
        HoldGoal("choice", context),
        fallback(
            "get there",
            DriveToGoal("carry", context),
            again(DriveToGoal("carry", context), at_goal=False),
        ),
        fallback(
            "leave it there",
            PutDownAtGoal("put down", context),
            again(PutDownAtGoal("put down", context), at_goal=True),
        ),
    )


class PutElsewhere(Step):
    """Says that the thing is where the person said instead; always fails: that is not the goal.

    Writes hand.elsewhere.
    """

    def update(self) -> Status:
        """Note the other place, and say so."""
        hand, say = self.situation.hand, self.context.say
        hand.elsewhere = hand.put_at
        it = say.it(self.situation.request.thing)
        return self.fail(f"I put {it} {say.at(hand.put_at)}")


class NotAtGoal(Step):
    """Says why the thing is not at its goal, and where it is now; always fails."""

    def update(self) -> Status:
        """Join the clauses."""
        hand, say = self.situation.hand, self.context.say
        name, why = self.situation.request.thing, why_not(self.context) or self.why_before()
        if hand.elsewhere:
            instead = f"I put {say.it(name)} {say.at(hand.elsewhere)} instead, as you said"
            return self.fail(f"{why}; {instead}")
        if hand.in_hand:
            silence = self.situation.dialogue.no_help
            why = f"{why}, and {silence}" if silence and silence not in why else why
            return self.fail(f"{why}; I still hold {say.the(hand.in_hand)}")
        if hand.lost:
            return self.fail(why if hand.lost == why else f"{hand.lost}, and {why}")
        return self.fail(f"{why}; {say.are(name)} not in my hand any more")


def why_not(context: MissionContext) -> str:
    """Where the thing could not be put, and why, as a clause; empty if no place has failed."""
    situation, say = context.situation, context.say
    it = say.it(situation.request.thing)
    tried = [
        why if say.the(place) in why else f"I could not put {it} {say.at(place)}: {why}"
        for place, why in situation.hand.unplaced.items()
    ]
    return "; ".join(tried)
