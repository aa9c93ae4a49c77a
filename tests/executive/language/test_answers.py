"""What an answer picks of what was offered, and what it names."""

import pytest

from executive.language.answers import how_many_of, named, picked
from executive.language.grammar import EnglishInterpreter

read = EnglishInterpreter().read
FRUIT = ("apple", "pear", "plum")


@pytest.mark.parametrize(
    ("answer", "meant"),
    [
        ("the first one", ("apple",)),
        ("The second, please", ("pear",)),
        ("the last one", ("plum",)),
        ("number 3", ("plum",)),
        ("2", ("pear",)),
        ("any", ("apple",)),
        ("I don't mind", ("apple",)),
        ("one of them", ("apple",)),
        ("all of them", FRUIT),
        ("both", ()),
        ("both of them", ()),
        ("the second one please, robot", ("pear",)),
        ("the first thing", ("apple",)),
        ("the fourth one", ()),
        ("0", ()),
        ("yes", ()),
        ("the pear", ()),
        ("no", ()),
    ],
)
def test_picks_without_a_name(answer: str, meant: tuple[str, ...]) -> None:
    assert picked(read(answer), FRUIT) == meant


def test_both_are_all_of_two() -> None:
    assert picked(read("both"), FRUIT[:2]) == FRUIT[:2]


@pytest.mark.parametrize(
    ("answer", "places"),
    [
        ("the first two", [1, 2]),
        ("the last three of them", [-3, -2, -1]),
        ("first two please", [1, 2]),
        ("the first and the third", [1, 3]),
    ],
)
def test_says_which_of_them_in_a_row(answer: str, places: list[int]) -> None:
    assert [thing.place_in_list for thing in read(answer).things.members] == places


@pytest.mark.parametrize(
    ("answer", "number"), [("two of them", 2), ("both of them but the pear", 0), ("it", 0)]
)
def test_so_many_are_any_of_them(answer: str, number: int) -> None:
    assert how_many_of(read(answer)) == number


def test_a_yes_picks_the_only_one_that_was_offered() -> None:
    assert picked(read("yes, please"), ("pear",)) == ("pear",)
    assert picked(read("yes, the apple"), ("pear",)) == ()


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("I think the pear", "pear"),
        ("No, the pear", "pear"),
        ("Bring the pear", "pear"),
        ("the red one", "red one"),
        ("I'd prefer the pear", "pear"),
        ("I would rather have the pear", "pear"),
        ("Let's say the pear", "pear"),
        ("The pear would be lovely", "pear"),
        ("the pear or the plum, I don't care", "pear or plum"),
        ("no I meant the pear", "pear"),
        ("the pear, no, the plum", "plum"),
        ("the pear or the plum", "pear or plum"),
        ("on the desk", ""),
        ("it", ""),
    ],
)
def test_names_what_it_means(answer: str, words: str) -> None:
    assert named(read(answer)) == words
