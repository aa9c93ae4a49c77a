"""Do what was asked with the thing that was found: find, take or bring."""

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import DELIVERY, FLOOR, Kind
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import Report
from trees.robot import DriveBack, LookForLost, PickUp, PutDownAt, SeeLost
from trees.team import Team


def act(team: Team) -> Behaviour:
    """A thing that was found, and is in the hand if it has to be -> reported or delivered."""
    situation = team.situation

    def from_a_place() -> Check:
        return Check("found at a place", team, lambda: situation.found is not None)

    return fallback(
        "act",
        sequence(
            "is there already",
            asked_to(team, Kind.BRING),
            Check("at the delivery place", team, lambda: situation.is_delivered),
            Report("report", team, "The {object} is here already, on the delivery table."),
        ),
        sequence(
            "bring",
            asked_to(team, Kind.BRING),
            deliver(team),
            fallback(
                "say so",
                sequence(
                    "from there",
                    from_a_place(),
                    Report("report", team, "Here is the {object} from {place}."),
                ),
                Report("report", team, "Here is the {object}."),
            ),
        ),
        sequence(
            "find",
            asked_to(team, Kind.FIND),
            from_a_place(),
            DriveBack("come back", team, "person"),
            Report("report", team, "The {object} is at {place}."),
        ),
        sequence(
            "take",
            asked_to(team, Kind.TAKE),
            from_a_place(),
            Report("report", team, "I took the {object} from {place} and hold it."),
        ),
        sequence(
            "have it",
            Check("had it before", team, lambda: situation.has_it and not situation.found),
            Check("not asked to bring", team, lambda: not situation.asks_to(Kind.BRING)),
            Report("report", team, "I hold the {object}."),
        ),
    )


def asked_to(team: Team, kind: Kind) -> Check:
    """Whether this kind of deed was asked for."""
    return Check(f"asked to {kind}", team, lambda: team.situation.asks_to(kind))


class HandIsFree(Step):
    """Succeeds if the hand is free for what is asked: it holds one thing at a time."""

    def update(self) -> Status:
        """Fail if another thing than the one that is asked for is in it."""
        assert self.situation.command
        held = self.situation.in_hand
        if held in (None, self.situation.object) or self.situation.command.kind == Kind.FIND:
            return Status.SUCCESS
        return self.fail(f"my hand holds the {held}; ask me first to bring that")


def deliver(team: Team) -> Behaviour:
    """Carry it and put it down; what falls on the way, or falls over there, is picked up once."""
    return sequence(
        "deliver",
        fallback(
            "bring it there",
            DriveBack("carry", team, DELIVERY),
            sequence(
                "after a fall",
                pick_up_again(team, FLOOR),
                DriveBack("carry", team, DELIVERY),
            ),
            SayItFell("it fell", team),
        ),
        fallback(
            "leave it there",
            PutDownAt("put down", team, DELIVERY),
            sequence(
                "after a fall",
                pick_up_again(team, DELIVERY, FLOOR),
                PutDownAt("put down", team, DELIVERY),
            ),
            SayItFell("it fell", team),
        ),
    )


def pick_up_again(team: Team, *spots: str) -> Behaviour:
    """Look for what fell from the hand at these spots, and pick it up."""
    situation = team.situation

    def views() -> Iterator[tuple[str, int]]:
        return ((spot, view) for spot in spots for view in range(team.robot.views(spot)))

    def choose(look: tuple[str, int]) -> None:
        situation.spot, situation.view = look

    return sequence(
        "pick it up again",
        Check("it fell", team, lambda: bool(situation.lost)),
        FirstOf(
            "look around",
            views,
            choose,
            sequence("glance", LookForLost("aim", team), SeeLost("see", team)),
        ),
        PickUp("pick", team),
    )


class SayItFell(Step):
    """Says that the thing fell, and why it could not be picked up; always fails."""

    def update(self) -> Status:
        """Put both clauses together, if there are two."""
        lost, why = self.situation.lost, self.situation.reason
        if not lost or lost == why:
            return self.fail(why)
        return self.fail(f"{lost}, and {why}")
