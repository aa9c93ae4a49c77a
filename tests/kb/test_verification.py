"""What is let through of a language model's reply."""

import pytest
from hostile_replies import FURNITURE, ROOMS, names, near_misses, replies
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.testing.bench import ontology, run_mission
from executive.types.goals import DriveTo
from executive.types.knowledge import Verdict
from kb.advice.verification import read, verify

KNOWN = ontology(True).place_names
some_furniture = st.sets(st.sampled_from(FURNITURE))


@pytest.mark.parametrize(
    "reply",
    [
        '{"places": ["desk", "sofa"]}',
        'Sure!\n```json\n{"places": ["desk", "sofa"]}\n```\nGood luck.',
        'As {asked}: {"places": [" desk ", "sofa"], "why": {"desk": 1}} {"places": 3}',
        '["desk", "sofa"]',
    ],
)
def test_the_names_are_read_from_the_json_object_in_a_reply(reply):
    assert read(reply) == ("desk", "sofa")


@pytest.mark.parametrize(
    "reply",
    ["", "on the desk", "[desk]", "{desk}", '{"places": [1]}', '{"places": ["desk"', '["desk"}']
    + ['{"places": null}', '{"why": "desk"}', "{" * 5000, '{"a":' * 5000],
)
def test_a_reply_that_is_not_in_the_format_is_none(reply):
    assert read(reply) is None


def test_a_reply_without_places_is_in_the_format():
    assert read('{"places": []}') == ()


def test_of_a_reply_as_long_as_a_book_only_the_end_is_read():
    desk, sofa = '{"places": ["desk"]}', '{"places": ["sofa"]}'
    assert read(desk + "{" * 500_000 + sofa) == ("sofa",)
    assert read(desk + '{"a":' * 500_000) is None


def test_half_a_character_in_a_name_can_be_written_down():
    names = read(r'{"places": ["\ud800", "a \ud83d\ude00"]}')
    assert names == ("\N{REPLACEMENT CHARACTER}", "a \N{GRINNING FACE}")


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


@given(replies, some_furniture)
def test_of_whatever_is_written_only_places_that_exist_pass(reply, among):
    written = read(reply) or ()
    "".join(written).encode()
    verdict = verify(written, KNOWN, tuple(among))
    assert set(verdict.furniture) <= (among or set(FURNITURE))
    assert set(verdict.rooms) <= set(ROOMS)
    assert set(verdict.dropped) <= set(written)


@given(near_misses)
def test_what_is_almost_a_place_is_none(name):
    assert verify([name], KNOWN) == Verdict((), (), (name,))


@settings(max_examples=30)
@given(st.lists(replies, min_size=4, max_size=9))
def test_whatever_the_model_writes_the_robot_drives_to_real_places_only(written):
    run = run_mission(
        "Find an apple.", elicit="generate", defaults=False, replies=written, answers=[]
    )
    driven = [goal.place for goal in run.goals if isinstance(goal, DriveTo)]
    assert set(driven) <= {*FURNITURE, "person"}
    assert run.model.requests


@given(st.lists(names, unique=True))
def test_every_name_either_passes_or_is_dropped(written):
    verdict = verify(written, KNOWN)
    passed = [n for n in written if n not in verdict.dropped]
    assert bool(passed) == bool(verdict.furniture or verdict.rooms)
    assert len(verdict.furniture) + len(verdict.rooms) <= len(passed)
