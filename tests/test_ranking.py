"""Scoring the known places."""

import math

import pytest
from conftest import four_rooms, ontology
from hypothesis import given
from hypothesis import strategies as st

from executive.events import Inbox
from executive.types import Place, RankRequest, Scored, Source, Usage
from kb.advisor import PlaceAdvisor
from kb.names import spoken
from kb.prompts import Prompts
from kb.ranking import answer, ranked
from kb.scripted import Scripted

PLACES = four_rooms().places()


def ranking(name: str, among: tuple[str, ...] = ()) -> RankRequest:
    adviser = PlaceAdvisor(ontology(True), Scripted([], Inbox()), remembers=False)
    return adviser.ranking(name, among)


def scored(*scores: float) -> Scored:
    names = tuple(f"place{i}" for i in range(len(scores)))
    return Scored(RankRequest("rank", (), (), names, names), scores, Usage())


def test_every_place_of_the_home_is_scored():
    assert ranking("hammer").places == tuple(place.name for place in PLACES)


def test_only_the_allowed_places_are_scored_if_the_ontology_names_some():
    assert ranking("hammer", ("sideboard", "desk")).places == ("desk", "sideboard")


def test_a_thing_is_named_in_words():
    assert ranking("power_drill").messages[-1].content == "Where is the power drill?"


def test_a_place_is_named_with_its_preposition_and_room():
    options = dict(zip(ranking("hammer").places, ranking("hammer").options, strict=True))
    assert options["cabinet_kitchen"] == "in the cabinet in the kitchen"
    assert options["dining_table"] == "on the dining table in the living room"
    assert answer(Place("den", "Desk", "den", "Office"), "on") == "on the den in the den"


def test_the_neutral_prompt_differs_in_the_thing_only():
    request = ranking("hammer")
    assert request.neutral[:-1] == request.messages[:-1]
    assert request.neutral[-1].content == "Where is the thing?"


def test_examples_are_turns_of_the_chat_and_not_about_any_object_of_the_ontology():
    request = ranking("hammer")
    assert [m.role for m in request.messages] == ["system", *["user", "assistant"] * 4, "user"]
    shown = " ".join(example for example, _ in Prompts.load().ranking.examples)
    assert not [name for name in ontology(True).objects() if spoken(name) in shown]


def test_the_best_score_comes_first_with_its_probability():
    first, second, third = ranked(scored(0.0, math.log(3), -math.inf))
    assert [c.place for c in (first, second, third)] == ["place1", "place0", "place2"]
    assert first.source == Source.LLM
    assert first.probability == pytest.approx(0.75)
    assert third.probability == 0.0


def test_equal_scores_stay_in_order():
    assert [c.place for c in ranked(scored(1.0, 1.0, 1.0))] == ["place0", "place1", "place2"]


def test_no_places_have_no_order():
    assert ranked(scored()) == ()


@given(st.lists(st.floats(allow_nan=False), min_size=1))
def test_probabilities_sum_to_one_and_fall(scores):
    probabilities = [c.probability for c in ranked(scored(*scores))]
    assert sum(probabilities) == pytest.approx(1.0)
    assert probabilities == sorted(probabilities, reverse=True)
