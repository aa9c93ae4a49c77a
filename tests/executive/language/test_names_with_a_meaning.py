"""Names that mean something else to the robot, and how little is read to find that out."""

import re
import tomllib
from itertools import chain

import pytest

from executive.language import naming
from executive.language.naming import heard_as, says_how_many
from executive.language.reader import ASSETS, english


def test_a_name_of_words_without_a_meaning_is_not_read(monkeypatch) -> None:
    monkeypatch.setattr(naming, "_english", None)
    assert heard_as("salad spinner") is None
    assert not says_how_many("salad spinner")


@pytest.mark.parametrize(
    "name",
    [
        *("left", "store", "spare box", "clear box", "go kart", "left closet"),
        *("spare parts", "left hand", "other things"),
    ],
)
def test_a_name_of_such_words_that_is_read_as_a_name_is_fine(name: str) -> None:
    assert heard_as(name) is None


def test_a_name_means_what_it_means_when_all_of_it_is_read(monkeypatch) -> None:
    """Of each seventh word that the language's files have, so that it does not take too long."""
    english_words = tomllib.loads((ASSETS / "english.toml").read_text("utf-8"))
    asking = chain.from_iterable(re.findall(r"[a-z]+", w) for w in english_words["declines"])
    words = [*asking, *english_words["numbers"], *sorted(english().vocabulary)[::7]]
    names = [form.format(word) for word in words for form in ("{}", "{} box", "tall {}")]
    told = [(heard_as(name), says_how_many(name)) for name in names]
    monkeypatch.setattr(naming, "_is_mere_name", lambda words: False)
    assert told == [(heard_as(name), says_how_many(name)) for name in names]
    assert {"says that somebody does not know", "says yes or no"} <= {said for said, _ in told}
