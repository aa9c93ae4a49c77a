"""Baselines and ablations of the experiment, each through the real tree."""

import json
from collections.abc import Iterable

import pytest

from executive.campaign import blocks
from executive.campaign.baselines import popular
from executive.campaign.journal import Row
from executive.campaign.routes import Routes
from executive.config import KnowledgeSystem, Settings, load_settings
from executive.events import Inbox
from executive.testing.bench import four_rooms
from executive.types.llm import ChatRequest
from kb.llm.scripted import Scripted

LLM = KnowledgeSystem.OKB_LLM


def missions(policy: str, *commands: str, **settings: object) -> list[Row]:
    given = {"world": "fake", "user": "oracle", "knowledge": LLM, "defaults": False, "llm": "none"}
    block = blocks.Block(load_settings(**{**given, **settings}), commands, policy)
    return [entry.row for entry in blocks.run(block)]


def with_replies(monkeypatch: pytest.MonkeyPatch, replies: Iterable[list[str]]) -> list[Scripted]:
    """Let policies ask a model that was told what to say; return it, once it is made."""
    made: list[Scripted] = []

    def model(settings: Settings, inbox: Inbox) -> Scripted:
        made.append(Scripted([json.dumps({"places": names}) for names in replies], inbox))
        return made[0]

    monkeypatch.setattr(blocks, "model_for_missions", model)
    return made


def test_nearest_always_goes_on_to_the_nearest_place_that_is_left() -> None:
    (row,) = missions("nearest", "Find a colored_wood_blocks.")
    routes, here = Routes(four_rooms()), four_rooms().robot_start[:2]
    left = {place.name for place in four_rooms().places()}
    visited = row.visited.split()[:5]
    assert len(visited) == 5
    for place in visited:
        assert place == min(left, key=lambda name: routes.length(here, routes.stand(name)))
        left.remove(place)
        here = routes.stand(place)


def test_chance_depends_on_the_seed_alone() -> None:
    first, again, other = (
        missions("random", "Find a colored_wood_blocks.", seed=seed)[0].visited
        for seed in (1, 1, 2)
    )
    assert first == again != other


def test_popularity_counts_where_other_things_are() -> None:
    (row,) = missions("popularity", "Find the scissors")
    assert row.visited.split()[:2] == ["counter_wagon", "cabinet_kitchen"]
    assert row.inquiries == 1


def test_popularity_leaves_out_the_record_of_the_asked_thing() -> None:
    order = popular()
    places = ["refrigerator", "desk", "shelf_lobby"]
    assert order("scissors", places) == ["shelf_lobby", "refrigerator", "desk"]
    assert order("hammer", places) == ["shelf_lobby", "desk", "refrigerator"]


def test_who_knows_the_truth_goes_straight_to_every_thing() -> None:
    for row in missions("true-first", "Find an apple.", "Take a mug.", "Bring a sugar_box."):
        assert (row.completed, row.visits, row.inquiries, row.spl) == (True, 1, 0, 1.0)


@pytest.mark.parametrize("defaults", [False, True])
def test_a_policy_that_always_asks_asks_even_for_what_the_ontology_knows(defaults: bool) -> None:
    rows = missions("always-asks", "Find a power_drill.", "Find an apple.", defaults=defaults)
    assert [(row.inquiries, row.visits) for row in rows] == [(1, 1), (1, 1)]


def test_without_verification_the_robot_sets_out_for_invented_places(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    names = ["pantry", "dining_table", "garage shelf"]
    with_replies(monkeypatch, [names])
    (row,) = missions("unverified", "Find an apple.", llm="embedded")
    assert (row.failed_visits, row.visited, row.inquiries) == (1, "dining_table", 0)
    assert (row.named, row.invented, row.completed) == (3, 2, True)


def test_with_verification_the_same_reply_sends_the_robot_nowhere_in_vain(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with_replies(monkeypatch, [["pantry", "dining_table"]])
    (row,) = missions("generate-form", "Find an apple.", llm="embedded")
    assert (row.failed_visits, row.visited, row.invented) == (0, "dining_table", 1)


def test_a_model_alone_is_told_nothing_of_the_home(monkeypatch: pytest.MonkeyPatch) -> None:
    models = with_replies(monkeypatch, [["fruit bowl"]])
    (row,) = missions("llm-alone", "Find an apple.", llm="embedded", defaults=True)
    (request,) = models[0].requests
    told = json.dumps([m.content for m in request.messages])
    assert isinstance(request, ChatRequest)
    assert not any(place.name in told for place in four_rooms().places())
    assert "enum" not in json.dumps(request.schema)
    assert (row.failed_visits, row.invented, row.inquiries, row.completed) == (1, 1, 1, True)


def test_all_time_of_a_mission_goes_into_something_that_has_a_name() -> None:
    (row,) = missions("nearest", "Bring a sugar_box.")
    known_s = row.thinking_time_s + row.driving_s + row.looking_s + row.handling_s
    assert known_s == pytest.approx(row.mission_time_s)
    assert min(row.driving_s, row.looking_s, row.handling_s) > 0


def test_policies_of_a_writing_model_differ_in_what_it_is_held_to() -> None:
    used = {
        name: blocks.Block(load_settings(), (), name).settings_used
        for name in ("rank", "generate", "generate-grammar")
    }
    assert [(s.elicitation, s.grammar) for s in used.values()] == [
        ("rank", False),
        ("generate", False),
        ("generate", True),
    ]


def test_okb_runs_once_whatever_policies_and_models_there_are() -> None:
    models = [load_settings(llm=llm) for llm in ("embedded", "http://localhost:1/v1")]
    found = blocks.grid(
        models, ["ours", "nearest"], list(KnowledgeSystem), ("Find a mug.",), seeds=2
    )
    keys = [key for block in found for key in block.keys]
    assert len(keys) == len(set(keys))
    of = [(key.system, key.policy, key.llm) for key in keys]
    assert of.count((KnowledgeSystem.OKB, "ours", "none")) == 2 * 2
    assert of.count((LLM, "ours", "embedded")) == of.count((LLM, "nearest", "none")) == 2 * 2
    assert len(of) == 2 * 2 * (1 + 2 * (2 + 1))
