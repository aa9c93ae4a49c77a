"""Who corrects themselves in the same breath gets what they meant in the end, or nothing."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.control import Control, control
from executive.language.grammar import EnglishInterpreter
from executive.language.meaning import Answer

read = EnglishInterpreter()


def asked(words: str) -> list[tuple[str, ...]]:
    """The tasks, each by verb, thing and place."""
    commands = (one for group in read.commands(words) for one in group)
    return [(one.kind.value, one.target, one.source or one.goal) for one in commands]


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("bring me the apple no wait the pear", [("bring", "pear", "")]),
        ("bring me the apple, sorry, I mean the pear", [("bring", "pear", "")]),
        ("Bring me the apple, actually, the pear", [("bring", "pear", "")]),
        ("bring the apple no the pear no sorry the mug", [("bring", "mug", "")]),
        ("Bring two apples, no, three", [("bring", "apples", "")]),
        ("go to the kitchen sorry the bedroom", [("go", "", "bedroom")]),
        ("Take the mug to the kitchen, no, to the desk", [("put", "mug", "desk")]),
        ("bring the mug from the desk no from the sofa", [("bring", "mug", "sofa")]),
        ("Bring the mug, no, put it on the desk", [("put", "mug", "desk")]),
        (
            "Find the pear and take the mug, no, the apple",
            [("find", "pear", ""), ("take", "apple", "")],
        ),
    ],
)
def test_what_is_said_last_counts(words: str, meant: list[tuple[str, ...]]) -> None:
    assert asked(words) == meant


@pytest.mark.parametrize(
    "words",
    [
        "Bring me the apple, no pear",
        "bring me the mug, no, no mug",
        "Bring me the mug, no, leave it",
        "bring me the mug no don't",
        "Bring me the mug, actually, don't bring me the mug",
        "Bring me the mug, no, nothing",
        "Bring me the mug, I mean, no",
        "Bring me the mug and the apple, no, the pear",
    ],
)
def test_a_no_that_may_mean_no_leads_to_no_deed(words: str) -> None:
    assert asked(words) == []


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        (
            "Bring the mug and the apple, no, the pear",
            [("bring", "mug", ""), ("bring", "pear", "")],
        ),
        ("Bring the mug and the apple, sorry, only the apple", [("bring", "apple", "")]),
        ("bring the apple the mug", [("bring", "apple", ""), ("bring", "mug", "")]),
    ],
)
def test_what_is_probably_meant_is_asked(words: str, meant: list[tuple[str, ...]]) -> None:
    assert (asked(words), read.remark(words)) == ([], "")
    likely = (one for group in read.without_slips(words) for one in group)
    assert [(one.kind.value, one.target, one.source or one.goal) for one in likely] == meant


TURNS = st.sampled_from(
    [", no, ", ". No, ", " no wait, ", ", I mean ", ", sorry, ", ", actually, "]
)


@given(
    st.lists(st.sampled_from(["the pear", "the red mug", "my hammer"]), min_size=2, max_size=4),
    st.data(),
)
def test_of_an_answer_the_last_counts(names: list[str], data: st.DataObject) -> None:
    answer = names[0] + "".join(data.draw(TURNS) + name for name in names[1:])
    assert read.read(answer) == read.read(names[-1])


@given(st.sampled_from([("on the desk", "on the sofa"), ("in the kitchen", "on my bed")]), TURNS)
def test_of_an_answer_with_a_place_the_last_counts(places: tuple[str, str], turn: str) -> None:
    assert read.read(turn.join(places)) == read.read(places[-1])


@pytest.mark.parametrize(
    "words", ["the pear, no", "the pear, no, not the apple", "no, the pear, no"]
)
def test_an_answer_that_is_denied_in_the_end_names_nothing(words: str) -> None:
    assert not isinstance(read.read(words), Answer)


@pytest.mark.parametrize(
    "words",
    [
        "Bring the pear. Actually, never mind, bring the peach.",
        "Bring the pear, never mind, bring the peach",
        "Bring the pear, forget that, bring the peach",
    ],
)
def test_who_never_minds_one_thing_and_asks_for_another_wants_that(words: str) -> None:
    assert asked(words) == [("bring", "peach", "")]
    assert control(words) is None


def test_who_never_minds_and_asks_for_nothing_stops_it() -> None:
    assert control("Bring the pear. Actually, never mind.") == Control.STOP
