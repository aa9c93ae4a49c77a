"""What the language model is told and asked."""

import json
import re

import pytest

from executive.errors import InputError
from executive.events import Inbox
from executive.testing.bench import four_rooms, ontology
from executive.types.llm import ChatRequest, Message
from kb.advice.lister import Lister
from kb.advice.prompts import TEXTS, Prompts
from kb.advice.ranker import Ranker
from kb.advice.verification import Reply
from kb.llm.scripted import Scripted

PLACES = four_rooms().places()


def lister(remembers: bool = False) -> Lister:
    return Lister(ontology(True), Scripted([], Inbox()), remembers=remembers)


def question(request: ChatRequest) -> str:
    return request.messages[-1].content


def edited(tmp_path, old: str, new: str):
    path = tmp_path / "prompts.toml"
    path.write_text(TEXTS.read_text().replace(old, new))
    return path


def test_the_system_prompt_holds_all_rooms_furniture_and_pairs():
    system = lister().inquiry("mug", ()).messages[0]
    assert system.role == "system"
    for place in PLACES:
        assert f"{place.name}: {place.room}" in system.content


def test_the_system_prompt_holds_the_output_format_and_every_request_its_schema():
    request = lister().inquiry("mug", ())
    assert json.dumps(Reply.model_json_schema()) in request.messages[0].content
    assert request.schema["properties"]["places"]["maxItems"] == 5


@pytest.mark.parametrize(
    ("request_", "choice"),
    [
        (lister().inquiry("mug", ()), [place.name for place in PLACES]),
        (lister().inquiry("mug", ("desk", "sofa")), ["desk", "sofa"]),
        (lister().furniture("mug", "lobby", ()), ["shelf_lobby", "sideboard"]),
        (lister().again("mug", ("desk", "sofa")), ["sofa", "desk"]),
    ],
)
def test_a_model_that_can_be_held_to_a_schema_can_only_name_allowed_places(request_, choice):
    assert request_.schema["properties"]["places"]["items"]["enum"] == choice


def test_without_default_locations_the_question_is_general():
    request = lister().inquiry("mug", ())
    assert request.label == "general_pos"
    assert "mug" in question(request)
    assert "5" in question(request)


def test_several_default_locations_narrow_the_question():
    request = lister().inquiry("mug", ("desk", "sofa"))
    assert request.label == "multiple_pos"
    assert "desk, sofa" in question(request)


def test_a_room_is_expanded_into_its_furniture():
    request = lister().furniture("mug", "kitchen", ())
    assert request.label == "furniture"
    assert "cabinet_kitchen, counter_wagon, high_table, refrigerator" in question(request)


def test_a_room_is_expanded_into_its_allowed_furniture_only():
    asked = question(lister().furniture("mug", "kitchen", ("high_table", "desk")))
    assert "high_table" in asked
    assert "cabinet_kitchen" not in asked
    assert "desk" not in asked


def test_asking_again_offers_the_allowed_places():
    request = lister().again("mug", ("desk", "sofa"))
    assert request.label == "again"
    assert "mug" in question(request)
    assert "sofa, desk" in question(request)


@pytest.mark.parametrize("remembers", [False, True])
def test_a_summary_follows_the_reply_that_it_is_about(remembers):
    asks = lister(remembers)
    asks.remember(asks.inquiry("mug", ()), "try the desk")
    request = asks.summarize("mug", "try the desk")
    assert request.label == "summarize"
    assert request.messages[-2] == Message("assistant", "try the desk")
    assert [m.role for m in request.messages] == ["system", "user", "assistant", "user"]


def test_no_placeholder_is_left_in_any_prompt():
    asks = lister()
    requests = [
        *(asks.inquiry("mug", ()), asks.inquiry("mug", ("desk", "sofa"))),
        *(asks.furniture("mug", "kitchen", ()), asks.again("mug", ())),
        asks.summarize("mug", "reply"),
        Ranker(ontology(True)).ranking("mug", ()),
    ]
    texts = [message.content for request in requests for message in request.messages]
    assert not [text for text in texts if re.search(r"#\w", text)]


def test_an_unknown_placeholder_is_refused(tmp_path):
    path = edited(tmp_path, "#top", "#number")
    with pytest.raises(InputError, match=r"general_pos.*no #number here; known are #object name"):
        Prompts.load(path)


def test_a_text_that_nobody_asks_for_is_refused(tmp_path):
    path = edited(tmp_path, "again =", "once_more =")
    with pytest.raises(InputError, match=r"toml: once_more: is no key; known are system, system_r"):
        Prompts.load(path)


def test_a_persons_file_replaces_only_the_texts_that_it_has(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('again = "Once more: #object name?"\n[ranking]\nquestion = "Whither #thing?"')
    ours, mine = Prompts.load(), Prompts.load(path)
    assert mine.again == "Once more: #object name?"
    assert mine.ranking.question == "Whither #thing?"
    assert mine.model_copy(update={"again": ours.again, "ranking": ours.ranking}) == ours
    assert mine.ranking.examples == ours.ranking.examples


def test_a_table_of_texts_cannot_be_a_text(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('ranking = "by eye"')
    with pytest.raises(InputError, match=r"mine.toml: ranking: Input should be"):
        Prompts.load(path)


def test_a_file_that_is_not_toml_is_refused(tmp_path):
    path = edited(tmp_path, "again =", "again")
    with pytest.raises(InputError, match=r"prompts.toml: is not TOML"):
        Prompts.load(path)
