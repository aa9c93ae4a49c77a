"""Words and phrases as people write them: what counts in them, and where one ends."""

import re
import tomllib
import unicodedata
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from executive.text import one_line

Words = tuple[str, ...]
"""Stems, as `words_of` makes them."""

MOST_WORDS = 6
"""Longest name that is looked for in a text."""
PREPOSITIONS = frozenset(("at", "by", "from", "in", "inside", "of", "on", "over", "top", "under"))
"""Words before a place that do not say which one it is."""
_NOT_ANY = ("anywhere", "anything", "any", "everywhere", "everything", "all")
"""Before "but", these leave out what follows."""
CLAUSE_ENDS = re.compile(
    r"[,;:.!?\n]|\b(?:or|and|then|maybe|perhaps)\b|\b"
    + "".join(rf"(?<!\b{word} )" for word in _NOT_ANY)
    + r"but\b"
)
ENGLISH: Mapping[str, Any] = tomllib.loads(
    (Path(__file__).parent / "assets" / "english.toml").read_text("utf-8")
)
"""The words of English that have a value of their own."""
NEGATION = re.compile(
    rf"\b(?:{'|'.join(ENGLISH['negations'])}|other than|(?:{'|'.join(_NOT_ANY)}) but)\b|n['’]t\b"
)
"""A clause with one of these names nothing."""
_DETERMINERS = frozenset(("a", "an", "any", "my", "our", "some", "that", "the", "this", "your"))


_APOSTROPHES = re.compile("[’‘`´ʼ′]")


_JOINER = "\u2060"
"""Unicode's word joiner, which is not seen: of what people say, it is left out (`one_line`)."""
_BEFORE_NAME = re.compile(rf"(?<![^ ,]){_JOINER}")


def in_one_piece(name: str) -> str:
    """A name of several words as one that no grammar takes apart; `in_pieces` undoes it."""
    return "".join(f"{_JOINER}{word}" for word in name.split())


def in_pieces(text: str) -> str:
    """The text with the words of each name apart again."""
    return _BEFORE_NAME.sub("", text).replace(_JOINER, " ")


def plain_letters(text: str) -> str:
    """One line in lower case; full-width letters are plain, and apostrophes of one kind."""
    straight = _APOSTROPHES.sub("'", text)
    return one_line(unicodedata.normalize("NFKC", straight)).lower()


def words_of(text: str) -> Words:
    """The stems of the words, without determiners: "The Sugar-Boxes" -> `("sugar", "box")`.

    Case, underscores, hyphens and all other punctuation do not count.
    """
    plain = unicodedata.normalize("NFKC", text).upper().casefold()
    return tuple(stem(word) for word in re.findall(r"[^\W_]+", plain) if word not in _DETERMINERS)


def place_words(text: str) -> Words:
    """The words that say which place it is: all but the prepositions."""
    return tuple(word for word in words_of(text) if word not in PREPOSITIONS)


def stem(word: str) -> str:
    """A form that an English noun shares with its regular plural: "shelves", "shelf" -> "shelf".

    It need not be a word itself: "apples", "apple" -> "appl".
    """
    if word.endswith("s") and not word.endswith("ss") and len(word) > 3:
        word = word.removesuffix("s")
    if len(word) > 3:
        word = word.removesuffix("e")
    if word.endswith("v"):
        return word.removesuffix("v") + "f"
    if word.endswith("i"):
        return word.removesuffix("i") + "y"
    return word


def is_plural(name: str) -> bool:
    """Whether a name has the ending of a regular plural: "tables", "side tables"."""
    return name.endswith("s") and not name.endswith("ss")


def spoken(name: str) -> str:
    """A name as one says it: `sugar_box` -> "sugar box", `LivingRoom` -> "living room"."""
    apart = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", name)
    return " ".join(apart.replace("_", " ").replace("-", " ").split()).lower()
