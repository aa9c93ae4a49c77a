"""Do what was asked with the thing that was found: find, take or bring."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import DELIVERY, Kind
from trees.deliver import deliver
from trees.nodes import Check, Step, fallback, sequence
from trees.person import Report
from trees.robot import DriveBack
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
                    "elsewhere",
                    Check("on other furniture", team, lambda: situation.put_at != DELIVERY),
                    Report(
                        "report",
                        team,
                        "I put the {object} on {surface}; "
                        "I could not put it on the delivery table: {why}.",
                    ),
                ),
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
            Check("in my hand", team, lambda: situation.has_it),
            Report("report", team, "I took the {object} from {place} and hold it."),
        ),
        sequence(
            "have it",
            Check("had it before", team, lambda: situation.has_it and not situation.found),
            Check("not asked to bring", team, lambda: not situation.asks_to(Kind.BRING)),
            Report("report", team, "I hold the {object}."),
        ),
        SayHowFar("not all of it", team),
    )


def asked_to(team: Team, kind: Kind) -> Check:
    """Whether this kind of deed was asked for."""
    return Check(f"asked to {kind}", team, lambda: team.situation.asks_to(kind))


class SayHowFar(Step):
    """Says what was found out although not all was done that was asked for; always fails."""

    def update(self) -> Status:
        """Who asks where a thing is wants to know it, even if the robot cannot come back."""
        found, why = self.situation.found, self.situation.reason
        if self.situation.asks_to(Kind.FIND) and found:
            return self.fail(f"the {self.situation.object} is at {found.place}, but {why}")
        if self.situation.asks_to(Kind.TAKE) and not self.situation.has_it:
            return self.fail(f"the {self.situation.object} is not in my hand any more")
        return self.fail(why)
