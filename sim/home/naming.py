"""What rooms and furniture may be called: by these names they are spoken of, logged and found."""

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import dropwhile, zip_longest

from executive.language.naming import Fault, place_fault
from executive.language.phrases import place_words, spoken
from executive.types.home import DELIVERY, FLOOR, HAND, PERSON

LONGEST = 64
"""Characters of a name."""
TAKEN = frozenset(
    {PERSON, DELIVERY, FLOOR, HAND, "gripper", "robot", "map", "base_link", "world", "home"}
    | {"camera", "everywhere", "nowhere", "nothing", "none", "here", "there", "yes", "no", "stop"}
    | {"quit", "exit", "unknown", "me", "him", "her", "it", "them", "us", "you", "one", "other"}
    | {"another", "both", "all", "anything", "anywhere", "something", "somewhere", "everything"}
)
"""What already means something, in commands, in answers or as a frame."""
_BETWEEN = frozenset("_-' ")
_UNSEEN = re.compile(
    "[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u3164\ufe00-\ufe0f\uffa0\U000e0100-\U000e01ef]"
)
"""What counts as letters and marks, and shows nothing (Unicode: Default_Ignorable_Code_Point)."""
_LIKE_LATIN = frozenset(("LATIN", "GREEK", "CYRILLIC", "ARMENIAN", "CHEROKEE"))
"""Alphabets that have letters which look like those of another one."""
RULE = f"use up to {LONGEST} letters, digits, and single _ - ' or blanks between them"


def name_fault(name: str) -> str | None:
    """Why something cannot be called this; None if it can."""
    if not name.strip():
        return "is empty"
    if len(name) > LONGEST:
        return f"is longer than {LONGEST} characters"
    wrong = next((c for c in name if not (_is_of_words(c) or c in _BETWEEN)), None)
    if wrong is not None:
        return f"has the character {ascii(wrong)}"
    if (
        name[0] in _BETWEEN
        or unicodedata.category(name[0])[0] == "M"
        or name[-1] in _BETWEEN
        or "  " in name
    ):
        return "does not begin and end with a letter or a digit, or has two blanks in a row"
    if word := next(filter(_is_of_two_alphabets, re.split(r"[-_' ]", name)), ""):
        return f"has letters of two alphabets in one word, {ascii(word)}, and looks like another"
    return None


def _is_of_two_alphabets(word: str) -> bool:
    """Whether it may look like a word that it is not: with a Cyrillic letter in "desk"."""
    return _of_one_alphabet(word) != word


def _of_one_alphabet(word: str) -> str:
    """The word without letters of a second one that look like those of its first."""
    alphabets = [unicodedata.name(letter, "").partition(" ")[0] for letter in word]
    others = _LIKE_LATIN - {next((one for one in alphabets if one in _LIKE_LATIN), "")}
    return "".join(letter for letter, of in zip(word, alphabets, strict=True) if of not in others)


def folded(name: str) -> str:
    """The same for names that nobody would keep apart: `The Side Tables` is side_table."""
    return "".join(place_words(spoken(name)))


def taken_fault(name: str) -> Fault | None:
    """Why the name is no name for a place, as it means something else; None if it is one."""
    if folded(name) in _TAKEN:
        return "this name has a meaning of its own", "give another name"
    if DELIVERY in re.findall(r"[a-z]+", spoken(name)):
        return f"an answer with {DELIVERY!r} in it names the delivery table", "give another name"
    return place_fault(name)


def alike(names: Sequence[str], rooms: Sequence[str] = ()) -> Iterator[tuple[str, ...]]:
    """Names that are the same or would not be kept apart, each such set once.

    In a room (`rooms` has what the room of each is called), the name may be said with the room
    first: `cabinet_kitchen` is the "kitchen cabinet".
    """
    groups = defaultdict(list)
    for name, room in zip_longest(names, rooms, fillvalue=""):
        of_room = set(place_words(spoken(room)))
        words = sorted(place_words(spoken(name)), key=lambda word: word not in of_room)
        groups["".join(words)].append(name)
    yield from (tuple(group) for group in groups.values() if len(group) > 1)


def usable(text: str) -> str:
    """The text with what no name may have left out; `home` if nothing remains."""
    kept = "".join(c if _is_of_words(c) or c in "_-" else "_" for c in text)
    kept = re.sub("[^_-]+", lambda word: _of_one_alphabet(word[0]), kept)
    begun = dropwhile(lambda c: c in _BETWEEN or unicodedata.category(c)[0] == "M", kept)
    return "".join(begun)[:LONGEST].rstrip("_-") or "home"


def _is_of_words(character: str) -> bool:
    """Whether it is a letter, a digit, or a mark on one, of any script, that can be seen."""
    return unicodedata.category(character)[0] in "LMN" and not _UNSEEN.match(character)


_TAKEN = frozenset(map(folded, TAKEN))
