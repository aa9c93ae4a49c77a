"""Where several things are, told in one breath."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.meaning import Statement
from executive.language.pronouns import resolved
from executive.language.reader import english
from executive.language.spoken import NOTHING

THINGS = st.sampled_from(["mug", "pear", "hammer", "power drill"])
PLACES = st.sampled_from(["on the desk", "in the kitchen", "on my bed"])
JOINED = st.sampled_from([". ", ", ", " and ", ", and "])


def told(words: str) -> list[tuple[str, str]]:
    """Each thing with its place, in the order in which they are told."""
    said = resolved(english().read(words), NOTHING)
    found = []
    while said is not None:
        assert isinstance(said, Statement), words
        found += [(thing.words, said.where.words) for thing in said.things.members]
        said = said.more
    return found


@given(st.lists(st.tuples(THINGS, PLACES), min_size=1, max_size=4), JOINED, st.booleans())
def test_each_of_them_is_heard(each: list[tuple[str, str]], joined: str, full: bool) -> None:
    verbs = ["is", *("is" if full else "" for _ in each[1:])]
    parts = (
        f"the {thing} {verb} {place}" for (thing, place), verb in zip(each, verbs, strict=True)
    )
    assert told(joined.join(parts)) == [(thing, place.split()[-1]) for thing, place in each]


WHERE = st.lists(PLACES, min_size=1, max_size=2, unique=True)


def is_there(words: str) -> dict[str, bool]:
    """Of each place that is told of, whether the thing is there."""
    said = resolved(english().read(words), NOTHING)
    found = {}
    while said is not None:
        assert isinstance(said, Statement), words
        for place in (said.where, *said.where.others):
            found[place.words] = not said.denied
        said = said.more
    return found


@pytest.mark.parametrize(
    "form",
    [
        "The {} is not {}",
        "the {} isn't {}",
        "There is no {} {}",
        "There isn't any {} {}",
        "I think the {} is not {}",
        "I don't think the {} is {}",
        "the {} is no longer {}",
        "The {} is not {} any more",
    ],
)
@given(THINGS, WHERE, st.sampled_from([" or ", " and not "]))
def test_where_it_is_not_is_told(form: str, thing: str, places: list[str], joined: str) -> None:
    joined = " or " if "any more" in form or "think the {} is {}" in form else joined
    denied = is_there(form.format(thing, joined.join(places)))
    assert denied == {place.split()[-1]: False for place in places}


@pytest.mark.parametrize(
    ("words", "there"),
    [
        ("The mug is on the desk, not on the bed", {"desk": True, "bed": False}),
        ("The mug is not on the desk but on the bed", {"desk": False, "bed": True}),
        ("The mug is not on the desk, it's on the bed", {"desk": False, "bed": True}),
        ("The mug is neither on the desk nor on the bed", {"desk": False, "bed": False}),
        ("It is not on the desk", {"desk": False}),
        ("They are not on the desk or on the bed", {"desk": False, "bed": False}),
    ],
)
def test_where_it_is_and_where_it_is_not_are_told_apart(words: str, there: dict[str, bool]) -> None:
    assert is_there(words) == there


@pytest.mark.parametrize(
    ("words", "places"),
    [
        ("I put the mug on the desk and the pear on the bed", ["desk", "bed"]),
        ("There is a mug on the desk and a pear in the kitchen", ["desk", "kitchen"]),
        ("I took the mug to the kitchen", ["kitchen"]),
        ("I've moved the mug to the desk", ["desk"]),
        ("The mug's on the desk", ["desk"]),
    ],
)
def test_what_somebody_did_with_things_tells_where_they_are(words: str, places: list[str]) -> None:
    assert [place for _, place in told(words)] == places


def test_it_is_what_was_told_of_before() -> None:
    assert told("The mug is on the desk. I put it in the kitchen") == [
        ("mug", "desk"),
        ("mug", "kitchen"),
    ]
