"""Where a thing is, and where it is to go, in other words than the name of a place alone."""

import pytest

from executive.language.grammar import EnglishInterpreter

read = EnglishInterpreter()


@pytest.mark.parametrize(
    ("words", "goal"),
    [
        ("Put the mug where the pear is", "next to pear"),
        ("Put the mug with the pear", "next to pear"),
        ("Put the mug on the same table as the pear", "next to pear"),
        ("Take the mug to the kitchen and wait there", "kitchen"),
        ("After that, take the mug to the kitchen and wait", "kitchen"),
    ],
)
def test_where_a_thing_goes_may_be_where_another_one_is(words: str, goal: str) -> None:
    [[command]] = read.commands(words)
    assert (command.target, command.goal) == ("mug", goal)


@pytest.mark.parametrize(
    ("words", "goal"),
    [
        ("Put the mug in the fridge, please, and the pear too", "fridge"),
        ("Take the mug to the desk, and then the pear as well", "desk"),
        ("Take the mug from the sofa to the desk and the pear, too", "desk"),
    ],
)
def test_what_is_named_behind_a_place_goes_there_too(words: str, goal: str) -> None:
    commands = [one for group in read.commands(words) for one in group]
    assert [(one.target, one.goal) for one in commands] == [("mug", goal), ("pear", goal)]
    assert commands[1].source == ""


@pytest.mark.parametrize(
    "words",
    [
        "Bring the mug that I left on the desk",
        "Bring the mug I put on the desk",
        "Bring the mug which is on the desk",
    ],
)
def test_where_it_was_left_is_where_it_is(words: str) -> None:
    [[command]] = read.commands(words)
    assert (command.target, command.source) == ("mug", "desk")


@pytest.mark.parametrize(
    ("words", "verb"),
    [
        ("Go to the kitchen and see if there's any fruit", "check"),
        ("Go to the kitchen and count the fruit", "count"),
        ("Go to the kitchen and find the fruit", "find"),
    ],
)
def test_what_is_asked_of_a_place_where_it_is_sent_is_about_that_place(
    words: str, verb: str
) -> None:
    [[command]] = read.commands(words)
    assert (command.kind, command.target, command.source) == (verb, "fruit", "kitchen")
