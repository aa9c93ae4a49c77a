"""Languages that are not spoken here: whether words are of one, and whether they deny in it."""

import re
import tomllib
import unicodedata
from collections.abc import Collection
from pathlib import Path

_FILE = tomllib.loads(
    (Path(__file__).parent / "assets" / "other_languages.toml").read_text("utf-8")
)


def _all(name: str) -> frozenset[str]:
    return frozenset(word for words in _FILE[name].values() for word in words.split())


_DENIALS = _all("denials")
_WORDS = _all("words") | _DENIALS
_ANYWHERE = re.compile("|".join(map(re.escape, sorted(_all("denials_anywhere")))))
_WORD = re.compile(r"[^\s,]+")


def is_other(text: str, own: Collection[str]) -> bool:
    """Whether words in lower case are of another language, as far as that can be told.

    Args:
        text: the words.
        own: words of the language that is spoken, which tell nothing.
    """
    if not text.isascii() and not _is_latin(text):
        return True
    words = text.replace("-", " ").replace(",", " ").split()
    ours = sum(word in own for word in words)
    theirs = sum(word in _WORDS and word not in own for word in words)
    return theirs > ours and (theirs > 1 or len(words) < 3)


def _is_latin(text: str) -> bool:
    """Whether at least half of the letters are such as English has, with or without accents."""
    letters = [letter for letter in text if letter.isalpha()]
    latin = sum("LATIN" in unicodedata.name(letter, "") for letter in letters)
    return latin * 2 >= len(letters)


def denial(text: str) -> str:
    """A word among them that denies in some language; empty if there is none."""
    found = next((word for word in _apart(text) if word in _DENIALS), "")
    part = _ANYWHERE.search(text)
    return found or (part[0] if part else "")


def _apart(text: str) -> list[str]:
    """The words, also what is short for two: "n'apporte" has "ne" in it."""
    return [word for said in _WORD.findall(text) for word in (said, *_short(said))]


def _short(word: str) -> list[str]:
    begin, apostrophe, _ = word.partition("'")
    return [f"{begin}e"] if apostrophe else []
