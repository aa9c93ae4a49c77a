"""Names as people write them, brought to one form, so that "The Sugar-Boxes" finds sugar_box."""

import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rapidfuzz import process
from rapidfuzz.distance import OSA

from executive.types import Place

Words = tuple[str, ...]
"""Stems, as `words_of` makes them."""

MOST_WORDS = 6
"""Longest name of a place that is looked for in a text."""

SHORTEST_WITH_A_SLIP = 4
SLIP_LIKENESS = 0.75
"""One letter in four may be wrong, missing, or swapped with the next."""

_DETERMINERS = frozenset(("a", "an", "any", "my", "our", "some", "that", "the", "this", "your"))
_PREPOSITIONS = frozenset(("at", "by", "from", "in", "inside", "of", "on", "over", "top", "under"))
_CLAUSE_ENDS = re.compile(r"[,;:.!?\n]|\b(?:or|and|then|but|maybe|perhaps)\b")
_ENUMERATION = re.compile(r"^\s*(?:\d+\s*[.):]|[-*•])\s*")
_NEGATION = re.compile(r"\b(?:not|no|never|nowhere|except|neither|nor|cannot)\b|n['’]t\b")


def words_of(text: str) -> Words:
    """The stems of the words, without determiners: "The Sugar-Boxes" -> `("sugar", "box")`.

    Case, underscores, hyphens and all other punctuation do not count.
    """
    plain = unicodedata.normalize("NFKC", text).casefold()
    return tuple(stem(word) for word in re.findall(r"[^\W_]+", plain) if word not in _DETERMINERS)


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


def spoken(name: str) -> str:
    """A name as one says it: `sugar_box` -> "sugar box", `LivingRoom` -> "living room"."""
    apart = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", name)
    return " ".join(apart.replace("_", " ").replace("-", " ").split()).lower()


@dataclass(frozen=True, slots=True)
class Reading:
    """The furniture and rooms that a phrase fits, and its words that fit nothing."""

    furniture: tuple[str, ...] = ()
    rooms: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()


class PlaceNames:
    """Finds the furniture and the rooms of a home in what people and models write.

    A piece of furniture goes by its name (`cabinet_kitchen`, "kitchen cabinet"), by its name less
    the room ("cabinet"), and by what its class is called ("cupboard"). The first of these that
    fits anything counts: "desk" is the desk named so, not every piece of class Desk.
    """

    def __init__(
        self, places: Sequence[Place], called: Mapping[str, Sequence[str]] | None = None
    ) -> None:
        """Index the home; `called` says what furniture and room classes are called."""
        self._room_of = {place.name: place.room for place in places}
        self._pieces_in: dict[str, list[str]] = {}
        for place in places:
            self._pieces_in.setdefault(place.room, []).append(place.name)
        called = called or {}

        def names_of(kind: str) -> Iterable[str]:
            return (spoken(kind), *called.get(kind, ()))

        rooms = (
            [(_content(p.room), p.room) for p in places],
            [(_content(name), p.room) for p in places for name in names_of(p.room_kind)],
        )
        furniture = (
            [(words, p.name) for p in places for words in _orders(p)],
            [(_content(base_name(p)), p.name) for p in places],
            [(_content(name), p.name) for p in places for name in names_of(p.kind)],
        )
        self._rooms, self._furniture = index_by_words(*rooms), index_by_words(*furniture)
        self._vocabulary = {
            word for tier in (*rooms, *furniture) for words, _ in tier for word in words
        }

    def find(self, text: str) -> tuple[str, ...]:
        """All furniture that a text names, in its order; a room stands for its furniture.

        Clauses that deny ("not on the desk", "I don't know") name nothing. A slip of the finger
        ("dinning table") is read as the word that it is near to.
        """
        found: list[str] = []
        for clause in _CLAUSE_ENDS.split(text.casefold()):
            if _NEGATION.search(clause):
                continue
            reading = self._read(map(self._without_slip, _content(clause)))
            found.extend(reading.furniture)
            for room in reading.rooms:
                found.extend(self._pieces_in[room])
        return unique(found)

    def exactly(self, name: str) -> Reading:
        """The one piece of furniture or the one room that all of a name fits, else nothing."""
        reading = self._read(_content(_ENUMERATION.sub("", name)))
        if reading.unknown or len(reading.furniture) + len(reading.rooms) != 1:
            return Reading()
        return reading

    def rooms_of(self, furniture: Iterable[str]) -> tuple[str, ...]:
        """The rooms that these pieces of furniture stand in."""
        return unique(self._room_of[name] for name in furniture if name in self._room_of)

    def _read(self, content: Iterable[str]) -> Reading:
        """The places in the words of one phrase: "in the cupboard of the kitchen".

        A room beside furniture narrows it down; a room alone stands for itself.
        """
        words = list(content)
        furniture: list[str] = []
        rooms: list[str] = []
        unknown: list[str] = []
        while words:
            length, found, into = self._longest_match(words, furniture, rooms)
            if found:
                into.extend(found)
            else:
                unknown.append(words[0])
            del words[:length]
        if furniture and rooms:
            furniture = [name for name in furniture if self._room_of[name] in rooms]
            rooms = []
        return Reading(unique(furniture), unique(rooms), tuple(unknown))

    def _without_slip(self, word: str) -> str:
        """The word of a name that this one is a slip of, else the word itself."""
        if word in self._vocabulary or len(word) < SHORTEST_WITH_A_SLIP:
            return word
        nearest = process.extract(
            word, self._vocabulary, scorer=OSA.normalized_similarity, score_cutoff=SLIP_LIKENESS
        )
        return str(nearest[0][0]) if len(nearest) == 1 else word

    def _longest_match(
        self, words: list[str], furniture: list[str], rooms: list[str]
    ) -> tuple[int, tuple[str, ...], list[str]]:
        for length in range(min(MOST_WORDS, len(words)), 0, -1):
            start = "".join(words[:length])
            for index, into in ((self._furniture, furniture), (self._rooms, rooms)):
                if start in index:
                    return length, index[start], into
        return 1, (), furniture


def _content(text: str) -> Words:
    """The words that say which place it is: all but the prepositions."""
    return tuple(w for w in words_of(text) if w not in _PREPOSITIONS)


def _orders(place: Place) -> tuple[Words, ...]:
    """A name and, where it says the room, the same with the room first: "kitchen cabinet"."""
    name, base = _content(place.name), _content(base_name(place))
    room = tuple(w for w in name if w not in base)
    return name, (*room, *base)


def base_name(place: Place) -> str:
    """A piece's name as one says it, less its room: `cabinet_kitchen` -> "cabinet"."""
    room = {*words_of(place.room), *words_of(spoken(place.room_kind))}
    words = spoken(place.name).split()
    return " ".join([w for w in words if stem(w) not in room] or words)


def index_by_words(*tiers: Sequence[tuple[Words, str]]) -> dict[str, tuple[str, ...]]:
    """Words, run together -> all names that go by them in the first tier that knows them.

    Run together, "bed room" and "sugarbox" find bedroom and sugar_box too.
    """
    index: dict[str, tuple[str, ...]] = {}
    for tier in tiers:
        fresh: dict[str, list[str]] = {}
        for words, name in tier:
            if words and "".join(words) not in index:
                fresh.setdefault("".join(words), []).append(name)
        index.update({words: unique(names) for words, names in fresh.items()})
    return index


def unique(names: Iterable[str]) -> tuple[str, ...]:
    """The names without repetitions, in their order."""
    return tuple(dict.fromkeys(names))
