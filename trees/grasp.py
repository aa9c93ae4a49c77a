"""Get hold of the thing that was found: pick it up, try again, search again."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import Kind
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.robot import DriveToCandidate, PickUp
from trees.search import look_over, search
from trees.team import Team


def grasp(team: Team) -> Behaviour:
    """Get hold of it, unless it may stay where it is; if it is gone, search it again."""
    situation = team.situation

    def may_stay() -> bool:
        delivered = situation.asks_to(Kind.BRING) and situation.is_delivered
        return delivered or situation.asks_to(Kind.FIND)

    return fallback(
        "grasp",
        Check("it may stay there", team, may_stay),
        Check("in my hand", team, lambda: situation.has_it),
        get_hold(team),
        sequence(
            "search again",
            Check("it is gone", team, lambda: situation.gone),
            ForgetSighting("begin anew", team),
            search(team),
            get_hold(team, Check("in my hand", team, lambda: situation.has_it)),
        ),
    )


def get_hold(team: Team, *first: Behaviour) -> Behaviour:
    """Pick it up; after a miss look again and try another approach, as long as it is there.

    What is in `first` may make that needless.
    """
    situation = team.situation
    more_tries = [f"try {number}" for number in range(2, team.rules.grasps + 1)]
    return fallback(
        "get hold",
        *first,
        PickUp("pick", team),
        FirstOf(
            "try again",
            lambda: more_tries,
            lambda _: None,
            sequence(
                "another approach",
                Check("it was there", team, lambda: not situation.gone),
                DriveToCandidate("return", team),
                look_over(team),
                PickUp("pick", team),
            ),
        ),
    )


class ForgetSighting(Step):
    """The thing is no longer where it was seen."""

    def update(self) -> Status:
        """Begin the search anew."""
        self.situation.detection = self.situation.found = None
        self.situation.gone = False
        return Status.SUCCESS
