"""What an answer picks of what was offered, and what it names."""

import pytest

from executive.language.answers import named, picked
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
        ("the fourth one", ()),
        ("0", ()),
        ("yes", ()),
        ("the pear", ()),
        ("no", ()),
    ],
)
def test_picks_without_a_name(answer: str, meant: tuple[str, ...]) -> None:
    assert picked(read(answer), FRUIT) == meant


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
        ("the pear or the plum", "pear or plum"),
        ("on the desk", ""),
        ("it", ""),
    ],
)
def test_names_what_it_means(answer: str, words: str) -> None:
    assert named(read(answer)) == words
