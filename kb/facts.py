"""The memory: timed facts about what was seen, missed, said, taken and put down where.

Facts are only ever added. What is believed follows from their order. It is kept in a table of its
own, so that a question takes as long with a million facts as with ten.
"""

import logging
import sqlite3
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from pathlib import Path
from types import MappingProxyType
from typing import Self

from executive.errors import InputError
from executive.text import printable
from kb.facts_file import opened

log = logging.getLogger(__name__)

MOST_BELIEFS, MOST_PLACES, MOST_NAME = 10_000, 100, 200
"""Limits: objects with a belief, places of one object, characters of a name."""
EVERYTHING = "everything"
"""The object of a fact of kind LOOKED."""
SAID_THERE, DENIED_THERE = 0, -1
"""Values of the column `seen` of a belief that comes from the person: the thing is there, or not.

Any other value: it was seen or put there.
"""
MOST_LOOKED_BACK = 20_000
"""`origins` reads only this many of the latest facts: that takes some milliseconds."""


class FactKind(StrEnum):
    """What happened to an object at a place."""

    SEEN = "seen"
    MISSED = "missed"
    """Looked for, and not seen."""
    SAID = "said"
    """The person said that it is there."""
    DENIED = "denied"
    """The person said that it is not there."""
    TAKEN = "taken"
    """The robot picked it up there; after that it is at no place."""
    PUT = "put"
    """The robot put it down there."""
    LOOKED = "looked"
    """All of the place was looked at: what was not seen is not there."""


@dataclass(frozen=True, slots=True)
class Fact:
    """One fact; `time_s` is UTC (seconds since 1970)."""

    kind: FactKind
    object: str
    place: str
    time_s: float


class FactStore:
    """Implements `Facts` with an SQLite file; each fact is one committed transaction.

    No fact is lost if the process is killed at any moment (write-ahead log). If the disk is full,
    or the file gets damaged, a warning says that the fact was not kept, and the mission goes on.
    Several processes may create and use the same file at the same time.
    """

    def __init__(
        self,
        file: Path | None = None,
        *,
        learns: bool = True,
        now: Callable[[], float] = time.time,
    ) -> None:
        """Open the file, or create it.

        Args:
            file: where facts are kept; None: in memory, until the process ends.
            learns: whether facts are added; if not, the file is only read.
            now: the time that new facts get (UTC, seconds since 1970).

        Raises:
            InputError: if the file cannot be opened, or is not a file of facts.
        """
        self._learns = learns
        self._now = now
        self._where = printable(file or "memory")
        self._database = opened(file, learns=learns)
        self._failing = False
        """Whether the last access failed, and a warning has said so."""

    @classmethod
    def believing(
        cls,
        beliefs: Mapping[str, Sequence[str]],
        origins: Mapping[str, Sequence[str]] = MappingProxyType({}),
        denials: Mapping[str, Sequence[str]] = MappingProxyType({}),
        *,
        learns: bool = True,
    ) -> Self:
        """A store in memory, as long as the process, that believes what another one did."""
        store = cls()
        kinds = (FactKind.TAKEN, FactKind.SAID, FactKind.DENIED)
        for kind, known in zip(kinds, (origins, beliefs, denials), strict=True):
            store.load(
                Fact(kind, name, place, 0.0)
                for name, places in known.items()
                for place in reversed(places)
            )
        store._learns = learns
        return store

    # --- the Facts protocol ---

    def saw(self, names: Iterable[str], place: str) -> None:
        """These objects were seen there."""
        for name in names:
            self._add(FactKind.SEEN, name, place)

    def missed(self, name: str, place: str) -> None:
        """The object was looked for there, and not seen."""
        self._add(FactKind.MISSED, name, place)

    def heard(self, name: str, places: Iterable[str]) -> None:
        """The person said that it is at one of these places, the likeliest first."""
        for place in reversed(tuple(places)):
            self._add(FactKind.SAID, name, place)

    def heard_not(self, name: str, places: Iterable[str]) -> None:
        """The person said that it is at none of these places."""
        for place in places:
            self._add(FactKind.DENIED, name, place)

    def took(self, name: str, place: str) -> None:
        """The robot has picked the object up there."""
        self._add(FactKind.TAKEN, name, place)

    def put(self, name: str, place: str) -> None:
        """The robot has put the object down there."""
        self._add(FactKind.PUT, name, place)

    def places_of(self, name: str) -> tuple[str, ...]:
        """The places where the object may be, the newest belief first.

        These are the places that the person has named since it was last seen or put down, then
        that place itself. A look in vain, or the person's denial, removes a place. What was taken
        is at no place until there is news of it.
        """
        return self._places(name, there=True)

    def places_denied(self, name: str) -> tuple[str, ...]:
        """Where the person said that it is not; until it is seen, or said to be there."""
        return self._places(name, there=False)

    def looked(self, place: str) -> None:
        """All of the place was looked at."""
        self._add(FactKind.LOOKED, EVERYTHING, place)

    # --- for those who keep and show facts ---

    def beliefs(self) -> dict[str, tuple[str, ...]]:
        """The places of every object that is believed to be somewhere."""
        return self._of_each(self.places_of)

    def denials(self) -> dict[str, tuple[str, ...]]:
        """The denied places of every object that has some; see `places_denied`."""
        return self._of_each(self.places_denied)

    def origins(self) -> dict[str, tuple[str, ...]]:
        """The places that the robot took each object from, the latest first."""
        query = (
            "SELECT object, place FROM fact WHERE kind = ? AND number > "
            "(SELECT max(number) FROM fact) - ? ORDER BY number DESC"
        )
        known: dict[str, dict[str, None]] = {}
        try:
            for name, place in self._database.execute(query, (FactKind.TAKEN, MOST_LOOKED_BACK)):
                if _is_name(name) and _is_name(place):
                    known.setdefault(name, {})[place] = None
        except _FAILURES as error:
            self._warn("facts could not be read", error)
        return {name: tuple(places)[:MOST_PLACES] for name, places in known.items()}

    def all(self) -> tuple[Fact, ...]:
        """Every fact, the oldest first; invalid rows are skipped.

        Raises:
            InputError: if the file cannot be read.
        """
        query = "SELECT kind, object, place, time_s FROM fact ORDER BY number"
        try:
            return tuple(Fact(FactKind(row[0]), *row[1:]) for row in self._rows(query))
        except _FAILURES as error:
            raise InputError(self._where, f"cannot be read: {error}") from error

    def since(self, number: int, most: int) -> tuple[tuple[Fact, ...], int]:
        """The facts after number `number`, at most the latest `most`; and the last one's number.

        If there are none, or they cannot be read, the number is the given one.
        """
        query = (
            "SELECT kind, object, place, time_s, number FROM "
            "(SELECT * FROM fact WHERE number > ? ORDER BY number DESC LIMIT ?) ORDER BY number"
        )
        try:
            rows = self._database.execute(query, (number, most)).fetchall()
        except _FAILURES as error:
            self._warn("facts could not be read", error)
            return (), number
        last = rows[-1][4] if rows else number
        return tuple(Fact(FactKind(row[0]), *row[1:4]) for row in rows if _is_fact(*row[:4])), last

    def _rows(self, query: str) -> Iterator[tuple[str, str, str, float]]:
        for kind, name, place, time_s in self._database.execute(query):
            if _is_fact(kind, name, place, time_s):
                yield kind, name, place, float(time_s)

    def load(self, facts: Iterable[Fact]) -> None:
        """Add facts with their own times."""
        insert = "INSERT INTO fact (time_s, kind, object, place) VALUES (?, ?, ?, ?)"
        deny = "INSERT OR REPLACE INTO belief VALUES (?, ?, ?, ?)"
        with self._database:
            for fact in facts:
                values = (fact.time_s, fact.kind, fact.object, fact.place)
                number = self._database.execute(insert, values).lastrowid
                if fact.kind == FactKind.DENIED:  # older files have no trigger for it
                    self._database.execute(deny, (fact.object, fact.place, DENIED_THERE, number))

    def forget(self, name: str | None = None) -> int:
        """Remove the facts about one object, or all; return how many there were.

        Raises:
            InputError: if the file cannot be written.
        """
        condition, values = ("", ()) if name is None else (" WHERE object = ?", (name,))
        try:
            with self._database:
                self._database.execute(f"DELETE FROM belief{condition}", values)
                return self._database.execute(f"DELETE FROM fact{condition}", values).rowcount
        except _FAILURES as error:
            raise InputError(self._where, f"cannot be changed: {error}") from error

    def close(self) -> None:
        """Close the file."""
        self._database.close()

    def _of_each(self, places_of: Callable[[str], tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
        query = "SELECT DISTINCT object FROM belief ORDER BY object LIMIT ?"
        try:
            names = [name for (name,) in self._database.execute(query, (MOST_BELIEFS,))]
        except _FAILURES as error:
            self._warn("facts could not be read", error)
            return {}
        known = {name: places_of(name) for name in names if _is_name(name)}
        return {name: places for name, places in known.items() if places}

    def _places(self, name: str, *, there: bool) -> tuple[str, ...]:
        try:
            places = tuple(place for place, so in self._believed(name).items() if so == there)
        except _FAILURES as error:
            self._warn(f"facts about the {name} could not be read", error)
            return ()
        self._failing = False
        return places

    def _believed(self, name: str) -> dict[str, bool]:
        """Whether the object is there, for each place that something is known of, newest first."""
        newest_first = self._database.execute(
            "SELECT place, seen FROM belief WHERE object = ? ORDER BY number DESC LIMIT ?",
            (name, MOST_PLACES),
        )
        places: dict[str, bool] = {}
        for place, seen in newest_first:
            if _is_name(place):
                places.setdefault(place, seen != DENIED_THERE)
            if seen not in (SAID_THERE, DENIED_THERE) and places.get(place, True):
                break
        return places

    def _add(self, kind: FactKind, name: str, place: str) -> None:
        if not self._learns:
            return
        try:
            self.load((Fact(kind, name, place, self._now()),))
        except _FAILURES as error:
            self._warn(f"a fact could not be kept ({name} {kind} {place})", error)
        else:
            self._failing = False

    def _warn(self, what: str, error: Exception) -> None:
        """Warn once, until an access succeeds again."""
        if not self._failing:
            log.warning("%s, %s: %s", printable(what), self._where, printable(error))
        self._failing = True


_KINDS = frozenset(FactKind)

_FAILURES = (sqlite3.Error, ValueError, OverflowError)
"""Raised by queries: the disk or the file fails, or the database cannot store a value."""


def _is_fact(kind: object, name: object, place: object, time_s: object) -> bool:
    timed = isinstance(time_s, int | float) and isfinite(time_s)
    return kind in _KINDS and _is_name(name) and _is_name(place) and timed


def _is_name(value: object) -> bool:
    return isinstance(value, str) and 0 < len(value) <= MOST_NAME
