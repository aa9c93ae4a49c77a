"""Do what was asked with the thing that was found: find, take or bring."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import DELIVERY, Kind
from trees.nodes import Check, Step, fallback, sequence
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

    def at_delivery() -> bool:
        return team.situation.found is not None and team.situation.found.place == DELIVERY

    return fallback(
        "act",
        sequence(
            "have it",
            holds_it(team),
            fallback(
                "what with it",
                sequence(
                    "hand over",
                    asked_to(Kind.BRING),
                    deliver(team),
                    Report("report", team, "Here is the {object}."),
                ),
                Report("report", team, "I hold the {object}."),
            ),
        ),
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
            "is there already",
            asked_to(Kind.BRING),
            Check("at the delivery place", team, at_delivery),
            Report("report", team, "The {object} is here already, on the delivery table."),
        ),
        sequence(
            "bring",
            asked_to(Kind.BRING),
            grasp(team),
            deliver(team),
            Report("report", team, "Here is the {object} from {place}."),
        ),
    )


def holds_it(team: Team) -> Check:
    """Whether the robot has the thing in its hand."""
    situation = team.situation
    return Check("in my hand", team, lambda: situation.in_hand == situation.object)


def deliver(team: Team) -> Behaviour:
    """Carry what is in the hand to the delivery place, and put it down."""
    return sequence(
        "deliver",
        DriveBack("carry", team, DELIVERY),
        PutDownAt("put down", team, DELIVERY),
    )


class HandIsFree(Step):
    """Succeeds if the hand is free for what is asked: it holds one thing at a time."""

    def update(self) -> Status:
        """Fail if another thing than the one that is asked for is in it."""
        assert self.situation.command
        held = self.situation.in_hand
        if held in (None, self.situation.object) or self.situation.command.kind == Kind.FIND:
            return Status.SUCCESS
        return self.fail(f"my hand holds the {held}; ask me first to bring that")


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
