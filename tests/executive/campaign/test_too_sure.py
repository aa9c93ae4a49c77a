"""A fault put in by hand, a belief that is far too sure, shows in its calibration and the cost."""

from dataclasses import replace
from functools import cache
from itertools import chain
from math import log

import pytest

from executive.campaign.journal import Row
from executive.campaign.observer import Observed
from executive.campaign.policies import policy_named
from executive.campaign.report.comparisons import trust
from executive.campaign.report.report import report
from executive.campaign.report.variants import variants
from executive.config import KnowledgeSystem
from executive.testing.bench import Run, four_rooms, run_mission
from logs.recorder import Stamp

QUESTION_S = 60.0
ROOMY = [place.name for place in four_rooms().places() if place.name != "dining_table"]
LIKELY = {place: 0.8**rank for rank, place in enumerate(sorted(ROOMY, reverse=True))}
"""How likely the mug truly is where, and as the model says."""
OF_A_HUNDRED = {p: round(100 * chance / sum(LIKELY.values())) for p, chance in LIKELY.items()}


@cache
def missions(policy: str) -> list[Row]:
    """One for each place, as many times as the mug is there in a hundred."""
    each = ([mission(policy, place)] * often for place, often in OF_A_HUNDRED.items())
    return list(chain.from_iterable(each))


def observed(run: Run) -> Observed:
    seen = Observed()
    for record in run.notebook.records:
        seen.write(Stamp(0.0, 0.0), record)
    return seen


def mission(policy: str, truth: str) -> Row:
    run = run_mission(
        "Find the mug",
        search="plan",
        defaults=False,
        place={"mug": truth},
        replies=[[log(LIKELY.get(place.name, 1e-6)) for place in four_rooms().places()]],
        change=policy_named(policy),
    )
    sure, sure_of_it, as_likely = observed(run).believed(truth)
    cost = run.outcome.mission_time_s + QUESTION_S * run.outcome.inquiries
    return Row(
        policy,
        "four_rooms",
        "embedded",
        KnowledgeSystem.OKB_LLM,
        False,
        0,
        "Find the mug",
        0,
        status="done",
        cost_s=cost,
        sure=sure,
        sure_of_it=sure_of_it,
        as_likely=as_likely,
    )


def told(policy: str) -> dict[str, float]:
    table = trust(variants(missions(policy), ()))
    (line,) = table.rows
    return {head: float(str(line[n])) for n, head in enumerate(table.heads) if n > 1}


def cost(policy: str) -> float:
    rows = missions(policy)
    return sum(row.cost_s for row in rows) / len(rows)


def test_what_is_believed_as_it_is_so_is_calibrated() -> None:
    assert told("plan")["calibration error"] < 0.06


def test_who_is_too_sure_shows_in_the_calibration() -> None:
    assert told("too-sure")["calibration error"] > 0.4
    assert told("too-sure")["log score"] < told("plan")["log score"] - 1
    assert told("too-sure")["is right"] == told("plan")["is right"]


def test_who_is_too_sure_pays_for_it() -> None:
    assert cost("too-sure") > 1.05 * cost("plan")


@pytest.mark.usefixtures("no_plots")
def test_the_report_tells_it() -> None:
    parts = report(missions("plan"), {})
    assert any("could be trusted" in str(part) for part in parts)


def test_of_missions_without_a_plan_nothing_is_told() -> None:
    assert Observed().believed("desk") == (0.0, 0.0, 1)


def test_where_all_places_are_as_likely_none_of_them_is_always_right() -> None:
    run = run_mission("Find the mug", search="plan", defaults=False, llm=False)
    sure, sure_of_it, as_likely = observed(run).believed("desk")
    row = replace(missions("plan")[0], sure=sure, sure_of_it=sure_of_it, as_likely=as_likely)
    (line,) = trust(variants([row], ())).rows
    home = len(four_rooms().places())
    assert line[3:5] == [f"{1 / home:.2f}", "0.00"]
