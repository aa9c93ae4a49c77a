"""Grasp the thing that was found: pick it up, try again, search again."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Activity
from trees.by_plan import search
from trees.context import MissionContext
from trees.deeds.deed import meaning
from trees.driving import DriveToCandidate
from trees.handling import PickUp
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.search import look_over


def grasp(context: MissionContext) -> Behaviour:
    """Grasp the thing, unless it may stay where it is; if it is gone, search again."""
    situation = context.situation

    def may_stay() -> bool:
        asked, found = meaning(situation), situation.search.found
        ends = situation.request.goals if asked.at_goal else (asked.ends_at,)
        is_there = asked.carries and found is not None and found.place in ends
        return is_there or not asked.grasps

    return fallback(
        "grasp",
        Check("it may stay there", context, may_stay),
        Check("in my hand", context, lambda: situation.has_it),
        get_hold(context),
        sequence(
            "search again",
            Check("it is gone", context, lambda: situation.search.gone),
            ForgetSighting("begin anew", context),
            search(context),
            get_hold(context, Check("in my hand", context, lambda: situation.has_it)),
        ),
    )


def get_hold(context: MissionContext, *first: Behaviour) -> Behaviour:
    """Pick it up; after a miss, look again and try another approach, as long as it is there.

    If a behaviour in `first` succeeds, the thing is in the hand and this is skipped.
    """
    situation = context.situation
    more_tries = [f"try {number}" for number in range(2, context.parameters.grasps + 1)]
    return fallback(
        "get hold",
        *first,
        PickUp("pick", context),
        FirstOf(
            "try again",
            lambda: more_tries,
            sequence(
                "another approach",
                Check("it was there", context, lambda: not situation.search.gone),
                DriveToCandidate("return", context),
                look_over(context),
                PickUp("pick", context),
                activity=Activity.SEARCHING,
            ),
        ),
    )


class ForgetSighting(Step):
    """Forgets where the thing was seen: it is no longer there."""

    def update(self) -> Status:
        """Reset the search."""
        self.situation.search.detection = self.situation.search.found = None
        self.situation.search.gone = False
        return Status.SUCCESS
