"""What is let through of a language model's reply."""

import json

import pytest
from conftest import four_rooms, ontology
from hypothesis import given
from hypothesis import strategies as st

from executive.types import Verdict
from kb.verification import read, verify

KNOWN = ontology(True).place_names
FURNITURE = {place.name for place in four_rooms().places()}
ROOMS = {place.room for place in four_rooms().places()}

PLACE_WORDS = ["desk", "table", "kitchen", "the", "in", "cabinet", "room", "dining", "magic", "1."]
names = st.one_of(
    st.text(),
    st.sampled_from(sorted(FURNITURE | ROOMS)),
    st.lists(st.sampled_from(PLACE_WORDS)).map(" ".join),
)
json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text() | st.just("places"), inner),
)


@pytest.mark.parametrize(
    "reply",
    [
        '{"places": ["desk", "sofa"]}',
        'Sure!\n```json\n{"places": ["desk", "sofa"]}\n```\nGood luck.',
        'As {asked}: {"places": [" desk ", "sofa"], "why": {"desk": 1}} {"places": 3}',
    ],
)
def test_the_names_are_read_from_the_json_object_in_a_reply(reply):
    assert read(reply) == ("desk", "sofa")


@pytest.mark.parametrize(
    "reply",
    ["", "on the desk", '["desk"]', '{"place": "desk"}', '{"places": "desk"}', '{"places": [1]}']
    + ['{"places": ["desk"', '{"places": null}', "{" * 5000, '{"a":' * 5000],
)
def test_a_reply_that_is_not_in_the_format_is_none(reply):
    assert read(reply) is None


def test_a_reply_without_places_is_in_the_format():
    assert read('{"places": []}') == ()


@given(st.text() | json_values.map(json.dumps) | st.text(alphabet='{}[]",:places'))
def test_reading_never_raises(reply):
    assert read(reply) is None or isinstance(read(reply), tuple)


@given(st.text(), st.text())
def test_text_around_the_object_does_no_harm(before, after):
    before = before.replace("{", "(")
    assert read(f'{before}{{"places": ["desk"]}}{after}') == ("desk",)


def test_rooms_are_kept_apart_and_unknown_names_dropped():
    verdict = verify(["desk", "kitchen", "garage", "sofa"], KNOWN)
    assert verdict == Verdict(("desk", "sofa"), ("kitchen",), ("garage",))


@pytest.mark.parametrize(
    "name",
    ["cabinet_kitchen", "Kitchen Cabinet", "the cabinet (kitchen)", "Cabinet in the kitchen"]
    + ["on cabinet-kitchen", "2. cabinet", "cupboard", "cabinet_kitchen in kitchen"],
)
def test_furniture_is_recognised_as_people_write_it(name):
    assert verify([name], KNOWN).furniture == ("cabinet_kitchen",)


@pytest.mark.parametrize(
    "name",
    ["pool table", "table", "desk lamp", "cabinet in the bedroom", "desk and sofa", "the", ""]
    + ["kitchen or bedroom", "dining_table2"],
)
def test_what_fits_no_one_place_is_dropped(name):
    assert verify([name], KNOWN) == Verdict((), (), (name,))


def test_a_place_is_kept_once_in_the_order_of_the_reply():
    assert verify(["sofa", "desk", "the sofa"], KNOWN).furniture == ("sofa", "desk")


def test_only_the_allowed_places_and_their_rooms_pass():
    verdict = verify(["sofa", "desk", "kitchen", "bedroom"], KNOWN, among=["desk", "bed"])
    assert verdict == Verdict(("desk",), ("bedroom",), ("sofa", "kitchen"))


@given(st.lists(names), st.sets(st.sampled_from(sorted(FURNITURE))))
def test_no_unknown_name_passes_whatever_the_model_writes(written, among):
    verdict = verify(written, KNOWN, tuple(among))
    assert set(verdict.furniture) <= (among or FURNITURE)
    assert set(verdict.rooms) <= ROOMS
    assert set(verdict.dropped) <= set(written)


@given(st.lists(names, unique=True))
def test_every_name_either_passes_or_is_dropped(written):
    verdict = verify(written, KNOWN)
    passed = [n for n in written if n not in verdict.dropped]
    assert bool(passed) == bool(verdict.furniture or verdict.rooms)
    assert len(verdict.furniture) + len(verdict.rooms) <= len(passed)
