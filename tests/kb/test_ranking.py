"""Scoring the known places."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.phrases import spoken
from executive.testing.bench import four_rooms, ontology
from executive.types.home import Place
from executive.types.knowledge import Source
from executive.types.llm import RankRequest, Usage
from executive.types.results import Scored
from kb.advice.prompts import Prompts
from kb.advice.ranker import Ranker
from kb.advice.ranking import MOST_PRECEDENTS, Known, answer, rank_request, ranked
from kb.facts import FactStore
from kb.ontology.ontology import Ontology

PLACES = four_rooms().places()


def ranking(name: str, among: tuple[str, ...] = ()) -> RankRequest:
    return Ranker(ontology(True)).ranking(name, among)


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


def precedents(request: RankRequest) -> dict[str, tuple[str, ...]]:
    """The question about each precedent -> its places."""
    return {known.messages[-1].content: known.places for known in request.precedents}


def test_other_things_are_precedents_with_their_default_locations():
    known = precedents(ranking("mug"))
    assert known["Where is the hammer?"] == ("shelf_lobby",)
    assert known["Where is the sugar box?"] == ("cabinet_kitchen", "counter_wagon", "high_table")
    assert "Where is the mug?" not in known
    assert "Where is the colored wood blocks?" not in known


def test_precedents_are_only_those_that_are_in_one_of_the_allowed_places():
    known = precedents(ranking("scissors", ("sideboard", "desk")))
    assert list(known) == ["Where is the adjustable wrench?"]


def test_in_another_home_precedents_are_where_furniture_of_the_kind_is():
    home = [
        Place("cabinet_kitchen", "Cabinet", "kitchen", "Kitchen"),
        Place("wagon_kitchen", "Wagon", "kitchen", "Kitchen"),
    ]
    known = precedents(Ranker(Ontology(home)).ranking("mug", ()))
    assert known["Where is the bleach cleanser?"] == ("cabinet_kitchen", "wagon_kitchen")


def test_where_a_thing_was_seen_counts_and_not_where_it_usually_is():
    facts = FactStore()
    facts.saw(["hammer"], "desk")
    facts.saw(["colored_wood_blocks"], "bed")
    known = precedents(Ranker(ontology(True), facts=facts).ranking("mug", ()))
    assert known["Where is the hammer?"] == ("desk",)
    assert known["Where is the colored wood blocks?"] == ("bed",)
    facts.close()


def test_without_default_locations_and_facts_there_are_no_precedents():
    assert Ranker(ontology(False)).ranking("mug", ()).precedents == ()


def test_a_thing_and_its_precedents_are_told_with_their_class():
    request = ranking("power_drill")
    assert request.kind == "tool"
    first = request.precedents[0]
    assert first.kind == "tool"
    assert {known.kind for known in request.precedents} > {"tool", "fruit"}


def test_of_too_many_precedents_those_of_its_class_are_kept():
    texts, options = Prompts.load().ranking, [(PLACES[0], "in the cabinet")]
    others = [Known(f"tool{i}", "tool", (PLACES[0].name,)) for i in range(500)]
    others.append(Known("pear", "fruit", (PLACES[0].name,)))
    request = rank_request(Known("apple", "fruit"), options, texts, others)
    assert len(request.precedents) == MOST_PRECEDENTS
    assert request.precedents[0].kind == "fruit"


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
