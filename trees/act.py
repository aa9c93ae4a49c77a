"""Do what was asked with the thing that was found: find, take or bring."""

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import DELIVERY, FLOOR, Kind
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import Report
from trees.robot import (
    DriveBack,
    DriveToCandidate,
    LookForLost,
    PickUp,
    PutDownAt,
    SeeLost,
)
from trees.search import look_over, search
from trees.team import Team


def act(team: Team) -> Behaviour:
    """A found thing -> reported, held or delivered."""

    def asked_to(kind: Kind) -> Check:
        return Check(
            f"asked to {kind}",
            team,
            lambda: team.situation.command is not None and team.situation.command.kind == kind,
        )

    return fallback(
        "act",
        sequence(
            "find",
            asked_to(Kind.FIND),
            DriveBack("come back", team, "person"),
            Report("report", team, "The {object} is at {place}."),
        ),
        sequence(
            "take",
            asked_to(Kind.TAKE),
            grasp(team),
            Report("report", team, "I took the {object} from {place} and hold it."),
        ),
        sequence(
            "bring",
            asked_to(Kind.BRING),
            grasp(team),
            deliver(team),
            Report("report", team, "Here is the {object} from {place}."),
        ),
    )


def grasp(team: Team) -> Behaviour:
    """Get hold of it; if it is gone, search it again."""
    return fallback(
        "grasp",
        get_hold(team),
        sequence(
            "search again",
            Check("it is gone", team, lambda: team.situation.gone),
            ForgetSighting("begin anew", team),
            search(team),
            get_hold(team),
        ),
    )


def get_hold(team: Team) -> Behaviour:
    """Pick it up; after a miss look again and try another approach, as long as it is there."""
    more_tries = [f"try {number}" for number in range(2, team.rules.grasps + 1)]
    return fallback(
        "get hold",
        PickUp("pick", team),
        FirstOf(
            "try again",
            lambda: more_tries,
            lambda _: None,
            sequence(
                "another approach",
                Check("it was there", team, lambda: not team.situation.gone),
                DriveToCandidate("return", team),
                look_over(team),
                PickUp("pick", team),
            ),
        ),
    )


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


class ForgetSighting(Step):
    """The thing is no longer where it was seen."""

    def update(self) -> Status:
        """Begin the search anew."""
        self.situation.detection = self.situation.found = None
        self.situation.gone = False
        return Status.SUCCESS


class SayItFell(Step):
    """Says that the thing fell, and why it could not be picked up; always fails."""

    def update(self) -> Status:
        """Put both clauses together, if there are two."""
        lost, why = self.situation.lost, self.situation.reason
        if not lost or lost == why:
            return self.fail(why)
        return self.fail(f"{lost}, and {why}")
