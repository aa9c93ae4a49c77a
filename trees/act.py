"""Do what was asked with the thing that was found: find, take or bring."""

from py_trees.behaviour import Behaviour

from executive.types import DELIVERY, Kind
from trees.nodes import Check, fallback, sequence
from trees.person import Report
from trees.robot import DriveBack, DriveToCandidate, LookAtCandidate, PickUp, PutDownAt, SeeTarget
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
            DriveBack("carry", team, DELIVERY),
            PutDownAt("put down", team, DELIVERY),
            Report("report", team, "Here is the {object} from {place}."),
        ),
    )


def grasp(team: Team) -> Behaviour:
    """Pick it up; after a miss, look again and try once more."""
    return fallback(
        "grasp",
        PickUp("pick", team),
        sequence(
            "second try",
            DriveToCandidate("return", team),
            LookAtCandidate("aim", team),
            SeeTarget("see", team),
            PickUp("pick", team),
        ),
    )
