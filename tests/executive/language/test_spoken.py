"""What "it", "there", "another" and "again" stand for, by what was spoken of before."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.grammar import EnglishInterpreter
from executive.language.meaning import Request
from executive.language.spoken import NOTHING, Spoken, after, resolved

read = EnglishInterpreter()
FRUIT = Spoken(("apple", "pear"), "fruit", "coffee_table")


def command(words: str, spoken: Spoken = FRUIT, *, holds: bool = False) -> str:
    """The command in a line."""
    [[made]] = read.commands(words, spoken, holds=holds)
    places = (made.source and f"from {made.source}", made.goal and f"to {made.goal}")
    names = (made.kind.replace("_", " "), made.target, *places)
    return " ".join(filter(None, names)) + "".join(f", not {one}" for one in made.exceptions)


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("Bring it", "bring pear"),
        ("Give me that one", "bring pear"),
        ("Bring another one", "bring fruit, not apple, not pear"),
        ("Bring another pear", "bring pear, not apple, not pear"),
        ("Take the mug from there", "take mug from coffee_table"),
        ("Put the mug there", "put mug to coffee_table"),
        ("Put it on the desk", "put pear to desk"),
        ("Put it back", "put back pear"),
        ("Go there", "go to coffee_table"),
        ("Find the mug and bring it", "bring mug"),
    ],
)
def test_a_word_stands_for_what_was_spoken_of_last(words: str, meant: str) -> None:
    assert command(words) == meant


@pytest.mark.parametrize("words", ["Put it on the desk", "Put it down"])
def test_what_is_in_the_hand_is_what_is_put_somewhere(words: str) -> None:
    assert command(words, holds=True).split(" to ")[0].endswith("it")


@pytest.mark.parametrize(
    ("words", "goal"),
    [
        ("Put the mug on the desk, then put the hammer there", "desk"),
        ("Put the mug down and put the hammer next to it", "next to mug"),
    ],
)
def test_what_was_named_in_the_same_breath_comes_first(words: str, goal: str) -> None:
    [*_, [last]] = read.commands(words, FRUIT)
    assert (last.target, last.goal) == ("hammer", goal)


def test_them_are_all_that_were_spoken_of() -> None:
    said = resolved(read.read("Bring them"), FRUIT)
    assert isinstance(said, Request)
    assert said.tasks[0].things
    assert [thing.words for thing in said.tasks[0].things.members] == ["apple", "pear"]


def test_again_is_what_was_asked_for_last_with_its_names() -> None:
    bring = resolved(read.read("Bring it"), FRUIT)
    spoken = after(bring, FRUIT, things=("pear",))
    assert command("Do that again", spoken) == "bring pear"


@pytest.mark.parametrize("words", ["Again", "Bring another one", "Put the mug there"])
def test_nothing_is_guessed_if_nothing_was_spoken_of(words: str) -> None:
    assert read.remark(words) or command(words, NOTHING) == words.lower()


names = st.text(min_size=1, max_size=8)


@given(st.builds(Spoken, st.lists(names, max_size=3).map(tuple), names, names))
def test_a_recording_keeps_all_of_it(spoken: Spoken) -> None:
    words = after(read.read("If there is an apple on the desk, bring it, otherwise a pear"), spoken)
    assert Spoken.from_json(words.to_json()) == words
