"""What a questionnaire takes for an answer, and what the answers come to."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from executive.page.study.questionnaire import MOST_WORDS, Questionnaire, templates

MIXED = Questionnaire.model_validate(
    {
        "title": "Mixed",
        "points": 7,
        "items": [
            {"name": "good", "text": "It is good."},
            {"name": "bad", "text": "It is bad.", "reversed": True},
            {"name": "why", "text": "Why?", "answer": "words", "needed": False},
        ],
    }
)


def all_of(name: str, value: int) -> dict[str, int]:
    return {item.name: value for item in templates()[name].items}


def test_the_templates_have_the_layouts_that_they_are_named_after() -> None:
    known = templates()
    assert {name: len(one.items) for name, one in known.items()} == {
        "sus": 10,
        "nasa_tlx": 6,
        "godspeed": 24,
    }
    assert [item.reversed for item in known["sus"].items] == [False, True] * 5
    groups = known["godspeed"].scores(all_of("godspeed", 4))
    assert groups == dict.fromkeys(
        ("anthropomorphism", "animacy", "likeability", "intelligence", "safety"), 4.0
    )


def test_the_score_of_sus_is_as_its_author_computes_it() -> None:
    sus = templates()["sus"]
    given = dict(
        zip((item.name for item in sus.items), (4, 2, 5, 1, 3, 3, 4, 2, 5, 1), strict=True)
    )
    odd, even = list(given.values())[::2], list(given.values())[1::2]
    expected = 2.5 * (sum(v - 1 for v in odd) + sum(5 - v for v in even))
    assert sus.scores(given) == {"score": pytest.approx(expected)}


@pytest.mark.parametrize(("value", "score"), [(1, 0.0), (11, 50.0), (21, 100.0)])
def test_the_load_index_is_the_mean_of_its_scales(value: int, score: float) -> None:
    assert templates()["nasa_tlx"].scores(all_of("nasa_tlx", value)) == {"score": score}


@given(st.integers(1, 7), st.integers(1, 7))
def test_what_is_reversed_counts_the_other_way_round(good: int, bad: int) -> None:
    assert MIXED.scores({"good": good, "bad": bad})["score"] == (good + 8 - bad) / 2


@pytest.mark.parametrize(
    ("answers", "why"),
    [
        ([], "no answers"),
        ({"good": 1}, "bad is not answered"),
        ({"good": 0, "bad": 1}, "good should be 1 to 7"),
        ({"good": True, "bad": 1}, "good should be 1 to 7"),
        ({"good": "1", "bad": 1}, "good should be 1 to 7"),
        ({"good": 8, "bad": 1}, "good should be 1 to 7"),
        ({"good": 1, "bad": 1, "other": 1}, "no answers"),
        ({"good": 1, "bad": 1, "why": 3}, "why should be words"),
        ({"good": 1, "bad": 1, "why": "x" * (MOST_WORDS + 1)}, "why should be words"),
    ],
)
def test_what_is_no_whole_answer_is_not_taken(answers: Any, why: str) -> None:
    assert why in MIXED.fault(answers)


def test_what_need_not_be_answered_need_not() -> None:
    assert MIXED.fault({"good": 7, "bad": 1}) == ""
    assert MIXED.fault({"good": 7, "bad": 1, "why": "It was."}) == ""


def test_two_items_of_a_name_are_refused() -> None:
    item = {"name": "a", "text": "?"}
    with pytest.raises(ValidationError, match="two called 'a'"):
        Questionnaire.model_validate({"title": "T", "items": [item, item]})
