"""What a search costs, by policy, and things at places that are drawn."""

import pytest

from executive.campaign import ablations, blocks
from executive.campaign.__main__ import parser
from executive.campaign.campaign import Campaign
from executive.campaign.draws import commands, drawn
from executive.campaign.journal import Row
from executive.config import KnowledgeSystem, load_settings
from executive.testing.bench import four_rooms
from sim.objects.objects import load_objects


def mission(policy: str, command: str, draws: bool = False, **settings: object) -> Row:
    given = {"world": "fake", "user": "oracle", "knowledge": KnowledgeSystem.OKB}
    block = blocks.Block(load_settings(**{**given, **settings}), (command,), policy, draws=draws)
    (entry,) = blocks.run(block)
    return entry.row


def test_a_question_costs_what_the_setting_says_and_a_look_its_time() -> None:
    row = mission("paper", "Find the mug", defaults=False, question_s=40.0)
    assert row.inquiries == 1
    assert row.cost_s == pytest.approx(row.search_s + 40.0)
    assert 0 < row.search_s < row.mission_time_s


def test_who_asks_first_is_charged_what_the_others_are() -> None:
    row = mission("ask-first", "Find the mug", defaults=False)
    assert (row.inquiries, row.visits) == (1, 1)
    assert row.cost_s == pytest.approx(row.search_s + 60.0)


def test_the_plan_looks_where_the_papers_stages_ask() -> None:
    by_plan, by_stages = (mission(p, "Find the mug", defaults=False) for p in ("plan", "paper"))
    assert (by_plan.inquiries, by_stages.inquiries) == (0, 1)
    assert by_plan.cost_s < by_stages.cost_s


def test_where_all_places_may_be_planned_exactly_the_best_plan_is_the_plan() -> None:
    exact, plan = (mission(p, "Find the mug", defaults=False) for p in ("plan-exact", "plan"))
    assert (exact.visited, exact.cost_s) == (plan.visited, plan.cost_s)


def test_the_best_plan_is_one_among_the_places_that_allow_it(monkeypatch) -> None:
    monkeypatch.setattr(ablations, "EXACT", 2)
    exact, plan = (mission(p, "Find the mug", defaults=False) for p in ("plan-exact", "plan"))
    assert exact.visited != plan.visited


def test_every_thing_is_drawn_to_where_the_survey_has_it() -> None:
    places = {drawn(four_rooms(), "scissors", seed)["scissors"] for seed in range(20)}
    assert places == {"desk", "sideboard"}
    assert len(commands()) == len(load_objects())


def test_the_same_seed_draws_the_same_place() -> None:
    assert drawn(four_rooms(), "mug", 3) == drawn(four_rooms(), "mug", 3)


def test_a_mission_finds_the_thing_where_it_was_drawn() -> None:
    row = mission("plan", "Find the scissors", draws=True, seed=1)
    assert row.completed
    assert row.truth == drawn(four_rooms(), "scissors", 1)["scissors"]


def test_a_campaign_of_draws_asks_for_every_thing(tmp_path) -> None:
    options = parser().parse_args(["--draw", "--seeds", "1", "--out", str(tmp_path / "out")])
    campaign = Campaign(options)
    with campaign._folder.lock:
        assert {key.command for key in campaign._keys} == set(commands())
        assert all(block.draws for block in campaign._blocks)
