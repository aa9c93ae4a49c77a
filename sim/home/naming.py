"""Rules for the names of rooms, furniture and objects, which are used in speech and in logs."""

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import dropwhile, zip_longest

from executive.language.naming import Fault, place_fault
from executive.language.phrases import place_words, spoken
from executive.types.home import DELIVERY, FLOOR, HAND, PERSON

LONGEST = 64
"""The most characters of a name."""
TAKEN = frozenset(
    {PERSON, DELIVERY, FLOOR, HAND, "gripper", "robot", "map", "base_link", "world", "home"}
    | {"camera", "everywhere", "nowhere", "nothing", "none", "here", "there", "yes", "no", "stop"}
    | {"quit", "exit", "unknown", "me", "him", "her", "it", "them", "us", "you", "one", "other"}
    | {"another", "both", "all", "anything", "anywhere", "something", "somewhere", "everything"}
)
"""Names that already have a meaning in commands, in answers or as a frame."""
_BETWEEN = frozenset("_-' ")
_UNSEEN = re.compile(
    "[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u3164\ufe00-\ufe0f\uffa0\U000e0100-\U000e01ef]"
)
"""Invisible characters that count as letters or marks (Unicode: Default_Ignorable_Code_Point)."""
_LIKE_LATIN = frozenset(("LATIN", "GREEK", "CYRILLIC", "ARMENIAN", "CHEROKEE"))
"""Alphabets with letters that look like letters of another one."""
RULE = f"use up to {LONGEST} letters, digits, and single _ - ' or blanks between them"


def name_fault(name: str) -> str | None:
    """Why a text is not allowed as a name; None if it is."""
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
    """Whether a word mixes look-alike alphabets, as with a Cyrillic letter in "desk"."""
    return _of_one_alphabet(word) != word


def _of_one_alphabet(word: str) -> str:
    """The word without letters of other look-alike alphabets than that of its first such letter."""
    alphabets = [unicodedata.name(letter, "").partition(" ")[0] for letter in word]
    others = _LIKE_LATIN - {next((one for one in alphabets if one in _LIKE_LATIN), "")}
    return "".join(letter for letter, of in zip(word, alphabets, strict=True) if of not in others)


def folded(name: str) -> str:
    """A key that is equal for names that sound alike: `The Side Tables` and `side_table`."""
    return "".join(place_words(spoken(name)))


def taken_fault(name: str) -> Fault | None:
    """Why a place cannot have this name because it means something else; None if it can."""
    if folded(name) in _TAKEN:
        return "this name has a meaning of its own", "give another name"
    if DELIVERY in re.findall(r"[a-z]+", spoken(name)):
        return f"an answer with {DELIVERY!r} in it names the delivery table", "give another name"
    return place_fault(name)


def alike(names: Sequence[str], rooms: Sequence[str] = ()) -> Iterator[tuple[str, ...]]:
    """Sets of names that are equal or too similar to be told apart.

    Args:
        names: the names.
        rooms: the room of each, if it is in one. A name may be said with the room first:
            `cabinet_kitchen` is the "kitchen cabinet".
    """
    groups = defaultdict(list)
    for name, room in zip_longest(names, rooms, fillvalue=""):
        of_room = set(place_words(spoken(room)))
        words = sorted(place_words(spoken(name)), key=lambda word: word not in of_room)
        groups["".join(words)].append(name)
    yield from (tuple(group) for group in groups.values() if len(group) > 1)


def usable(text: str) -> str:
    """The text without anything that names must not have; `home` if nothing is left."""
    kept = "".join(c if _is_of_words(c) or c in "_-" else "_" for c in text)
    kept = re.sub("[^_-]+", lambda word: _of_one_alphabet(word[0]), kept)
    begun = dropwhile(lambda c: c in _BETWEEN or unicodedata.category(c)[0] == "M", kept)
    return "".join(begun)[:LONGEST].rstrip("_-") or "home"


def _is_of_words(character: str) -> bool:
    """Whether it is a visible letter, digit or mark of any script."""
    return unicodedata.category(character)[0] in "LMN" and not _UNSEEN.match(character)


_TAKEN = frozenset(map(folded, TAKEN))
