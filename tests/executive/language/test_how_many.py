"""How many things are meant, and which of them."""

import pytest

from executive.language.grammar import EnglishInterpreter
from executive.language.spoken import NOTHING, after

read = EnglishInterpreter()


@pytest.mark.parametrize(
    ("words", "number"),
    [
        ("Bring at least two fruits", 2),
        ("Bring no more than two fruits", 2),
        ("Bring up to three fruits", 3),
        ("Bring one or two fruits", 2),
        ("Bring me two to three fruits", 3),
        ("Bring a dozen fruits", 12),
        ("Bring half a dozen fruits", 6),
        ("Bring exactly 2 fruits", 2),
    ],
)
def test_a_bound_is_as_many_as_it_allows(words: str, number: int) -> None:
    [[command]] = read.commands(words)
    assert (command.target, command.number) == ("fruits", number)


@pytest.mark.parametrize("words", ["Bring two more fruits", "Bring two more", "Bring another two"])
def test_more_are_others_than_those_of_before(words: str) -> None:
    before = after(read.read("Bring two fruits"), NOTHING, things=("apple", "pear"))
    [[command]] = read.commands(words, before)
    assert (command.target, command.number) == ("fruits", 2)
    assert command.exceptions == ("apple", "pear")


@pytest.mark.parametrize(
    "words", ["Bring everything except what is on the desk", "Bring all but everything on the bed"]
)
def test_what_is_left_out_has_to_be_named(words: str) -> None:
    assert read.commands(words) == ()


@pytest.mark.parametrize(
    "words",
    [
        "Don't just bring the mug, bring the apple too",
        "Bring not only the mug but also the apple",
        "Bring not just the mug, but the apple, too",
    ],
)
def test_not_only_this_is_both(words: str) -> None:
    commands = [command for group in read.commands(words) for command in group]
    assert [command.target for command in commands] == ["mug", "apple"]


def test_what_is_to_be_gone_from_a_place_is_not_put_there() -> None:
    [[command]] = read.commands("Get rid of the mug on the desk")
    assert (command.kind, command.target) == ("clear", "mug")
    assert (command.source, command.goal) == ("desk", "")
