"""What a condition is about, and what is done then."""

import pytest

from executive.language.grammar import EnglishInterpreter
from executive.language.spoken import NOTHING, Spoken, after
from executive.types.commands import Command

read = EnglishInterpreter()
HAMMER = after(read.read("Find the hammer"), NOTHING, things=("hammer",), place="shelf")


def one(words: str, spoken: Spoken = NOTHING) -> Command:
    """The last task in the words."""
    return read.commands(words, spoken)[-1][0]


@pytest.mark.parametrize(
    ("words", "spoken", "checked"),
    [
        ("If it is not on the shelf, bring the mug", HAMMER, "hammer"),
        ("Unless it is on the shelf, bring the mug", HAMMER, "hammer"),
        ("Find the hammer, and if it isn't on the shelf, bring the mug", NOTHING, "hammer"),
        ("If it is not on the shelf, bring the mug", NOTHING, "mug"),
        ("Bring the mug unless it is on the shelf", HAMMER, "mug"),
    ],
)
def test_it_is_what_was_spoken_of_if_nothing_else_was_named(
    words: str, spoken: Spoken, checked: str
) -> None:
    command = one(words, spoken)
    assert (command.target, command.source) == (checked, "shelf")
    assert command.unless
    assert command.unless.target == "mug"


@pytest.mark.parametrize(
    ("words", "checked"),
    [
        ("If it is on the shelf, bring the mug", "hammer"),
        ("Bring the mug if it is on the shelf", "mug"),
        ("If the pear is on the shelf, bring the mug", "pear"),
    ],
)
def test_another_thing_may_have_to_be_there(words: str, checked: str) -> None:
    command = one(words, HAMMER)
    assert command.sought
    assert (command.target, command.sought.target) == ("mug", checked)


def test_what_has_to_be_there_may_be_anywhere_and_is_not_what_is_brought() -> None:
    command = one("Bring the pear if there is a mug")
    assert command.sought
    assert (command.target, command.sought.target, command.sought.source) == ("pear", "mug", "")


def test_there_is_where_the_robot_was_just_sent() -> None:
    command = one("Go to the kitchen. If the mug is there, bring it.")
    assert (command.target, command.source, command.conditional) == ("mug", "kitchen", True)


def test_if_so_and_otherwise_are_both_read_after_a_question() -> None:
    asked = after(read.read("Is the mug on the desk?"), NOTHING, things=("mug",), place="desk")
    command = one("If so, put it on the sofa, otherwise bring the pear", asked)
    assert (command.kind, command.target, command.goal) == ("put", "mug", "sofa")
    assert command.unless
    assert command.unless.target == "pear"


@pytest.mark.parametrize("word", ["provided", "assuming", "as long as", "provided that"])
def test_there_are_other_words_for_if(word: str) -> None:
    command = one(f"Bring the mug {word} it is on the desk")
    assert (command.target, command.source, command.conditional) == ("mug", "desk", True)


@pytest.mark.parametrize(
    "words",
    [
        "Put the mug on the shelf unless the pear is there",
        "Put the mug on the shelf if the pear is not on the shelf",
        "If the pear is not on the shelf, put the mug there",
    ],
)
def test_there_is_the_place_that_the_same_sentence_names(words: str) -> None:
    command = one(words, HAMMER)
    assert (command.target, command.source) == ("pear", "shelf")
    assert command.unless
    assert (command.unless.target, command.unless.goal) == ("mug", "shelf")


def test_it_is_done_otherwise_with_what_was_to_be_done_something_with() -> None:
    command = one("If the pear is on the shelf, put the mug there, otherwise put it on the desk")
    assert command.unless
    assert (command.goal, command.unless.target, command.unless.goal) == ("shelf", "mug", "desk")
