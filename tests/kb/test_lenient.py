"""How replies are read that are not quite in the output format."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kb.advice import commands, lenient
from kb.advice.lenient import values
from kb.advice.verification import read

BOTH = ("counter_wagon", "desk")


@pytest.mark.parametrize(
    "reply",
    [
        r'{"places": ["counter\_wagon", "desk"]}',
        r'{"places": ["counter\u005fwagon", "de\sk"]}',
        '{"places": ["counter_wagon", "desk",]}',
        '{"places": ["counter_wagon", "desk"],}',
        "{'places': ['counter_wagon', 'desk']}",
        "{\N{LEFT DOUBLE QUOTATION MARK}places\N{RIGHT DOUBLE QUOTATION MARK}: "
        "[\N{LEFT SINGLE QUOTATION MARK}counter_wagon\N{RIGHT SINGLE QUOTATION MARK}, `desk`]}",
        "{places: [counter_wagon, desk]}",
        "{'places': ('counter_wagon', 'desk',),}",
        "{'places': [('counter_wagon', 0.9), ('desk', 0.1)]}",
        "1. counter_wagon\n2. desk",
        "```\n1) **counter_wagon**,\n2) `desk`\n```\n",
        "- counter_wagon\n- desk\n",
        '{"Places": ["counter_wagon", "desk", null, ...]}',
        '{"places": [\n  "counter_wagon",  // sugar, too\n  /* or */ "desk"  # at last\n]}',
        '{"places": [{"name": "counter_wagon", "why": "kitchen"}, {"Place": "desk"}]}',
        '{"answer": {"places": ["counter_wagon", "desk"]}, "sure": true}',
        '["counter_wagon", "desk"]',
        '{"places": "counter_wagon, desk"}',
        '{"places": ["1. counter_wagon", "2) desk"]}',
        '{"places": {"1": "counter_wagon", "2": "desk"}}',
        '{"places": {"counter_wagon": 0.9, "desk": 0.1}}',
        '{"places": [["counter_wagon", 0.9], ["desk", 0.1]]}',
        '{"places": [{"counter_wagon": 0.9}, {"desk": null}]}',
        "{«places»: [«counter_wagon», ‹desk›]}",
        "{„places“: [„counter_wagon“, „desk”]}",
        '｛"places"：［"counter_wagon"，「desk」］｝',
        "{&quot;places&quot;: [&quot;counter_wagon&quot;, &quot;desk&quot;]}",
        r'"{\"places\": [\"counter_wagon\", \"desk\"]}"',
        '{"places": ["counter_wagon", "desk"]}, as you wrote: {"places": ["...", "..."]}',
        "Perhaps:\n```json\n['counter_wagon', 'desk']\n```\nIt's there [1].",
        '[{"name": "counter_wagon"}, {"name": "desk"}]',
        'It\'s in [see above: {"places": ["counter_wagon", "desk"]}',
        '{"places": ["cab"inet"]} is not right. {"places": ["counter_wagon", "desk"]}',
    ],
)
def test_names_are_read_as_models_write_them(reply: str) -> None:
    assert read(reply) == BOTH


@pytest.mark.parametrize("reply", ['{"places": "desk"}', '{"place": "desk"}', '{"places": [desk]}'])
def test_one_place_may_stand_alone(reply: str) -> None:
    assert read(reply) == ("desk",)


@pytest.mark.parametrize(
    "reply",
    ["It is here:\n1. counter_wagon\n2. desk", "1. desk\nI am sure.", "2. ", "desk", "(desk, bed)"],
)
def test_prose_and_a_list_among_it_are_no_answer(reply: str) -> None:
    assert read(reply) is None


@pytest.mark.parametrize(
    "reply",
    [
        '{"places": ["sofa"]}\nNo, that is wrong:\n{"places": ["desk"]}',
        '{"places": ["sofa"]} No. {"places": ["desk",]}',
        '{"places": ["sofa",]} No. {"places": ["desk"]}. ["bed"]',
        '["sofa"] or ["desk"]',
        '{"places": ["desk"]} as I said {"places": [1]} and {places}',
    ],
)
def test_the_last_answer_counts(reply: str) -> None:
    assert read(reply) == ("desk",)


@pytest.mark.parametrize(
    ("reply", "kind"),
    [
        (
            '{"kind": "take", "object": "mug"} Or rather {"kind": "bring", "object": "mug",}',
            "bring",
        ),
        ("{kind: Find, object: 'mug', why: 'it is gone'}", "find"),
    ],
)
def test_a_command_is_read_as_leniently(reply: str, kind: str) -> None:
    [asked] = commands.read(reply) or ()
    assert (asked.kind, asked.object) == (kind, "mug")


class Counted:
    """A pattern, and how often it is tried."""

    def __init__(self, pattern: re.Pattern[str]) -> None:
        self.pattern, self.tried = pattern, 0

    def match(self, text: str, at: int) -> re.Match[str] | None:
        self.tried += 1
        return self.pattern.match(text, at)


@pytest.mark.parametrize("quote", ["„", "“"])
def test_a_quote_that_nothing_closes_is_looked_for_once_a_line(
    quote: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    strings = Counted(lenient._STRING)
    monkeypatch.setattr(lenient, "_STRING", strings)
    list(values(f"[{quote}\\" * 500 + "\n" + f"[{quote}\\" * 500))
    assert strings.tried <= 4


pieces = st.lists(
    st.sampled_from(
        [
            *"{}[](),:\"'`#/* \n1a.«“„”：，｛［］｝",
            "places",
            '"desk"',
            '"places":',
            '{"places": [',
            "]}",
        ]
    )
    | st.text(max_size=3),
    max_size=40,
).map("".join)


@given(pieces)
def test_no_name_is_read_that_is_not_written_there(text: str) -> None:
    text = text.replace("\\", "")
    assert all(name in text for name in read(text) or () if "\N{REPLACEMENT CHARACTER}" not in name)


@given(pieces)
def test_a_value_ends_where_a_bracket_closes(text: str) -> None:
    assert all(text[end - 1] in ")]}）］｝" for end, _ in values(text))


@pytest.mark.parametrize(
    "unit",
    [
        "[\N{LEFT DOUBLE QUOTATION MARK}",
        "[«",
        "{",
        '[\\"',
        "[/*",
        '{"a":',
        "['",
        "[`",
        "[#",
        '["\\',
        "[1,",
        "[(",
        "(1,",
        "1. ",
        "[...",
        "{}",
    ],
)
def test_whatever_is_repeated_is_read_to_its_end(unit: str) -> None:
    assert read(unit * 5000 + ' \n"]} {"places": ["desk"]}') == ("desk",)
