"""The search: by one belief and a plan that weighs looking against asking; or by stages."""

from collections.abc import Iterator
from itertools import count, takewhile

from py_trees.behaviour import Behaviour

from executive.records import Activity
from trees.context import MissionContext
from trees.driving import Visit
from trees.hearing import consult, wants_advice, what_is_known
from trees.nodes import Check, FirstOf, as_long_as, beside, fallback, sequence
from trees.planning import (
    AskWhereItIs,
    DriveAsPlanned,
    HearOut,
    HoldAsPlanned,
    PlanNext,
    PlanStands,
    TellWhere,
)
from trees.search import (
    GiveUpSearch,
    look_over,
    look_where_the_words_say,
    may_be_elsewhere,
    search_by_stages,
)
from trees.ways import Ways


def search(context: MissionContext) -> Behaviour:
    """Find the object: writes `situation.search.detection` and `situation.search.found`."""
    if context.parameters.search == "paper":
        return search_by_stages(context)
    return search_by_plan(context)


def search_by_plan(context: MissionContext) -> Behaviour:
    """Hear all sources; then look or ask, whichever costs less, until the thing is seen."""
    situation = context.situation
    return fallback(
        "search",
        Check("in my hand", context, lambda: situation.hand.in_hand == situation.request.object),
        look_where_the_words_say(context),
        sequence(
            "look where it may be",
            may_be_elsewhere(context),
            what_is_known(context),
            until_it_is_seen(context),
        ),
        GiveUpSearch("not found", context),
    )


def until_it_is_seen(context: MissionContext) -> Behaviour:
    """Repeat the next step; meanwhile the language model may think about where the thing may be."""
    search, ways = context.situation.search, Ways(context)

    def steps() -> Iterator[int]:
        return takewhile(lambda _: not search.whereabouts.is_over, count(1))

    def steps_without_advice() -> Iterator[int]:
        return takewhile(lambda _: not wants_advice(context), steps())

    if context.model is None:
        return FirstOf("until it is seen", steps, next_step(context, ways))
    look_on = FirstOf("look on", steps_without_advice, next_step(context, ways))
    think_too = beside("think while moving", consult(context), look_on)
    return FirstOf("until it is seen", steps, think_too)


def next_step(context: MissionContext, ways: Ways) -> Behaviour:
    """Look at the best place; before that ask, or wait for the model, if that is better."""
    search = context.situation.search
    return sequence(
        "next step",
        fallback(
            "look or ask",
            PlanNext("plan", context, ways),
            *hear_the_model_out(context, ways),
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
        HoldAsPlanned("choice", context, ways),
        TellWhere("announce", context),
        sequence(
            "go and look",
            go_there(context, ways),
            look_over(context),
            activity=Activity.SEARCHING,
        ),
    )


def hear_the_model_out(context: MissionContext, ways: Ways) -> tuple[Behaviour, ...]:
    """Before a question to the person, wait for the language model if it is still thinking."""
    search = context.situation.search

    def may_help() -> bool:
        plan = search.whereabouts.plan
        return search.whereabouts.thinks and plan is not None and plan.looking is not None

    if context.model is None:
        return ()
    return (
        sequence(
            "hear the model out",
            Check("it is thinking", context, may_help),
            HearOut("wait for it", context),
            PlanNext("plan with that", context, ways),
        ),
    )


def go_there(context: MissionContext, ways: Ways) -> Behaviour:
    """Drive to the planned place; replan on the way if news makes another place better."""
    if context.model is None:
        return Visit("drive", context)
    return as_long_as(
        "as planned",
        PlanStands("the plan stands", context, ways),
        TellWhere("tell", context),
        DriveAsPlanned("drive", context),
    )
