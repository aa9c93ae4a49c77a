"""A home with more furniture than a language model can be told of at once."""

import json

import pytest

from executive.events import Inbox
from executive.types.home import Place
from executive.types.llm import Usage
from executive.types.results import Scored
from kb.advice.large_homes import BYTES_PER_TOKEN, MOST_OPTIONS, Alike
from kb.advice.lister import Lister
from kb.advice.ranker import Ranker
from kb.llm.scripted import Scripted
from kb.ontology.ontology import Ontology

KINDS = ("Table", "Cabinet", "Shelf", "Desk", "Sofa")
PLACES = [
    Place(f"{KINDS[i % 5].lower()}_{i}", KINDS[i % 5], f"room_{i % 20}", "Bedroom")
    for i in range(1000)
]
CONTEXT = 4096


@pytest.fixture(scope="module")
def lister() -> Lister:
    model = Scripted([], Inbox(), context_tokens=CONTEXT)
    return Lister(Ontology(PLACES), model, remembers=False)


def test_it_is_asked_about_by_rooms_and_each_prompt_fits(lister: Lister) -> None:
    first, again = lister.inquiry("mug", ()), lister.again("mug", ())
    furniture = lister.furniture("mug", "room_3", ())
    for request in (first, again, furniture):
        size = sum(len(message.content) for message in request.messages)
        assert size / BYTES_PER_TOKEN < CONTEXT - 256
    rooms = [f"room_{i}" for i in range(20)]
    assert ", ".join(rooms) in first.messages[0].content
    assert first.schema
    assert first.schema["properties"]["places"]["items"]["enum"] == rooms
    assert "shelf_3," not in again.messages[-1].content


def test_rooms_that_are_named_lead_to_their_furniture(lister: Lister) -> None:
    names = lister.read(json.dumps({"places": ["room_3", "attic"]}))
    assert names
    assert lister.verify(names, ()).rooms == ("room_3",)
    asked = lister.furniture("mug", "room_3", ()).messages[-1].content
    assert asked.count("_") > 50
    assert "desk_3" in asked
    assert "table_5," not in asked


def test_of_a_room_that_is_too_large_some_of_each_kind_are_told() -> None:
    places = [Place(f"desk_{i}", "Desk", "hall", "Lobby") for i in range(1500)]
    places += [Place(f"sofa_{i}", "Sofa", "hall", "Lobby") for i in range(1500, 1600)]
    model = Scripted([], Inbox(), context_tokens=512)
    asked = Lister(Ontology(places), model, remembers=False).furniture("mug", "hall", ())
    assert 4 < asked.messages[-1].content.count("sofa_") < 100


def test_places_that_differ_by_their_number_only_are_scored_once() -> None:
    ranker = Ranker(Ontology(PLACES))
    request = ranker.ranking("mug", ())
    assert request.options[0] == "on the table in the bedroom"
    assert len(request.options) == len(KINDS)
    ranked = ranker.ranked(Scored(request, (0.0, 9.0, 0.0, 1.0, 0.0), Usage()))
    assert [c.place for c in ranked[:2]] == ["cabinet_1", "cabinet_6"]
    assert len(ranked) == len(PLACES)
    assert sum(c.probability or 0.0 for c in ranked) == pytest.approx(1.0)


def test_each_place_of_a_home_that_is_not_large_stands_for_itself() -> None:
    few = PLACES[:MOST_OPTIONS]
    assert Alike.among(few).spoken_of() == few
