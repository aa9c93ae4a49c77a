"""Normalizes names as people write them, so that "The Sugar-Boxes" finds sugar_box."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rapidfuzz import process
from rapidfuzz.distance import OSA

from executive.language.phrases import (
    CLAUSE_ENDS,
    MOST_WORDS,
    NEGATION,
    Words,
    place_words,
    spoken,
    stem,
    words_of,
)
from executive.types.home import Place

SHORTEST_WITH_A_SLIP = 4
SLIP_LIKENESS = 0.75
"""One letter in four may be wrong, missing, or swapped with the next one."""
SHORT = 4
"""In words this short, letters may only be swapped: "hell" and "wall" are not "hall"."""

_ENUMERATION = re.compile(r"^\s*(?:\d+\s*[.):]|[-*•])\s*")


@dataclass(frozen=True, slots=True)
class Reading:
    """The furniture and rooms that match a phrase, and its words that match nothing."""

    furniture: tuple[str, ...] = ()
    rooms: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()


class PlaceNames:
    """Finds the furniture and rooms of a home in text by people and models.

    A piece of furniture has three kinds of names: its own (`cabinet_kitchen`, "kitchen cabinet"),
    this without the room ("cabinet"), and the names of its class ("cupboard"). The first kind that
    matches anything counts: "desk" is the piece of that name, not every piece of class Desk.
    """

    def __init__(
        self, places: Sequence[Place], called: Mapping[str, Sequence[str]] | None = None
    ) -> None:
        """Index the home; `called` gives the names of furniture and room classes."""
        self._room_of = {place.name: place.room for place in places}
        self._pieces_in: dict[str, list[str]] = {}
        for place in places:
            self._pieces_in.setdefault(place.room, []).append(place.name)
        called = called or {}

        def names_of(kind: str) -> Iterable[str]:
            return (spoken(kind), *called.get(kind, ()))

        rooms = (
            [(place_words(name), p.room) for p in places for name in (p.room, p.room_label)],
            [(place_words(name), p.room) for p in places for name in names_of(p.room_kind)],
        )
        furniture = (
            [(words, p.name) for p in places for words in _orders(p)],
            [(place_words(base_name(p)), p.name) for p in places],
            [(place_words(name), p.name) for p in places for name in names_of(p.kind)],
        )
        self._rooms, self._furniture = index_by_words(*rooms), index_by_words(*furniture)
        self._vocabulary = {
            word for tier in (*rooms, *furniture) for words, _ in tier for word in words
        }

    def find(self, text: str) -> tuple[str, ...]:
        """All furniture in a text, in its order; for a room, all its furniture.

        Clauses with a negation ("not on the desk", "I don't know") are ignored. A misspelling
        ("dinning table") is read as the nearest word.
        """
        found: list[str] = []
        for reading in self._readings(text):
            found.extend(reading.furniture)
            for room in reading.rooms:
                found.extend(self._pieces_in[room])
        return unique(found)

    def covers(self, text: str) -> bool:
        """Whether each clause names a place and contains no other words."""
        readings = list(self._readings(text))
        return bool(readings) and all(
            not reading.unknown and (reading.furniture or reading.rooms) for reading in readings
        )

    def exactly(self, name: str) -> Reading:
        """The one piece of furniture or room that all words of the name match, else nothing."""
        reading = self._read(place_words(_ENUMERATION.sub("", name)))
        if reading.unknown or len(reading.furniture) + len(reading.rooms) != 1:
            return Reading()
        return reading

    def rooms_of(self, furniture: Iterable[str]) -> tuple[str, ...]:
        """The rooms of these pieces of furniture."""
        return unique(self._room_of[name] for name in furniture if name in self._room_of)

    def _readings(self, text: str) -> Iterator[Reading]:
        """The reading of each clause that has a word and no negation."""
        for clause in CLAUSE_ENDS.split(text.casefold()):
            if not NEGATION.search(clause) and (words := place_words(clause)):
                yield self._read(map(self._without_slip, words))

    def _read(self, content: Iterable[str]) -> Reading:
        """The places in one phrase: "in the cupboard of the kitchen".

        A room together with furniture narrows it down; a room alone stands for itself.
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
        """The known word that this one misspells, if it is clear; else the word itself."""
        if word in self._vocabulary or len(word) < SHORTEST_WITH_A_SLIP:
            return word
        nearest = process.extract(
            word, self._vocabulary, scorer=OSA.normalized_similarity, score_cutoff=SLIP_LIKENESS
        )
        names = [str(name) for name, _, _ in nearest]
        if len(word) <= SHORT:
            names = [name for name in names if sorted(name) == sorted(word)]
        return names[0] if len(names) == 1 else word

    def _longest_match(
        self, words: list[str], furniture: list[str], rooms: list[str]
    ) -> tuple[int, tuple[str, ...], list[str]]:
        for length in range(min(MOST_WORDS, len(words)), 0, -1):
            start = "".join(words[:length])
            for index, into in ((self._furniture, furniture), (self._rooms, rooms)):
                if start in index:
                    return length, index[start], into
        return 1, (), furniture


def _orders(place: Place) -> tuple[Words, ...]:
    """All forms of a name: as it is, with the room first, and in full as the robot says it.

    As in "kitchen cabinet" and in "desk in the bedroom".
    """
    name, base, label = map(place_words, (place.name, base_name(place), place.label))
    room = tuple(w for w in name if w not in base)
    full = place_words(place.room_label or place.room)
    labelled = (label, (*label, *full)) if label else ()
    return name, (*room, *base), (*name, *full), (*base, *full), *labelled


def base_name(place: Place) -> str:
    """The spoken name of a piece without its room: `cabinet_kitchen` -> "cabinet"."""
    room = {*words_of(place.room), *words_of(spoken(place.room_kind))}
    words = spoken(place.name).split()
    return " ".join([w for w in words if stem(w) not in room] or words)


def index_by_words(*tiers: Sequence[tuple[Words, str]]) -> dict[str, tuple[str, ...]]:
    """Map words, joined to one, to the names that have them, in the first tier that knows them.

    Because they are joined, "bed room" and "sugarbox" find bedroom and sugar_box, too.
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
    """The names without repetitions, in order."""
    return tuple(dict.fromkeys(names))
