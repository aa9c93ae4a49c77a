"""Search: by one belief and a plan that weighs looking against asking; or by the paper's stages."""

from collections.abc import Iterator
from itertools import count, takewhile

from py_trees.behaviour import Behaviour

from executive.records import Activity
from trees.context import MissionContext
from trees.hearing import consult, what_is_known
from trees.nodes import Check, FirstOf, fallback, sequence
from trees.planning import AskWhereItIs, PlanNext, TellWhere, Ways
from trees.robot import Visit
from trees.search import GiveUpSearch, look_over, look_where_the_words_say, search_by_stages


def search(context: MissionContext) -> Behaviour:
    """An object -> `situation.search.detection` and `situation.search.found`."""
    if context.parameters.search == "paper":
        return search_by_stages(context)
    return search_by_plan(context)


def search_by_plan(context: MissionContext) -> Behaviour:
    """All sources are heard, then the robot looks or asks, whichever costs less, until it sees."""
    situation = context.situation

    def steps() -> Iterator[int]:
        return takewhile(lambda _: not situation.search.whereabouts.is_over, count(1))

    return fallback(
        "search",
        Check("in my hand", context, lambda: situation.hand.in_hand == situation.request.object),
        look_where_the_words_say(context),
        sequence(
            "look where it may be",
            what_is_known(context),
            FirstOf("until it is seen", steps, lambda _: None, next_step(context)),
        ),
        GiveUpSearch("not found", context),
    )


def next_step(context: MissionContext) -> Behaviour:
    """One look, at what is best to look at next; before it a question, if that is better."""
    search, ways = context.situation.search, Ways(context)
    return sequence(
        "next step",
        *consult(context),
        fallback(
            "look or ask",
            PlanNext("plan", context, ways),
            sequence(
                "ask first",
                Check("asking is better", context, lambda: not search.whereabouts.is_over),
                AskWhereItIs("ask where", context),
                PlanNext("plan anew", context, ways),
            ),
            sequence(
                "without the person",
                Check("something is left", context, lambda: not search.whereabouts.is_over),
                PlanNext("plan alone", context, ways),
            ),
        ),
        TellWhere("announce", context),
        sequence(
            "go and look",
            Visit("drive", context),
            look_over(context),
            activity=Activity.SEARCHING,
        ),
    )
