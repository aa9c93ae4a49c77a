"""What was seen where and when, looked for in vain, said, taken and put down: facts with a time.

Facts are only ever added. What is believed follows from the order in which they came, and is kept
beside them, so that a question takes as long with a million facts as with ten.
"""

import logging
import sqlite3
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Self

from executive.errors import InputError

log = logging.getLogger(__name__)

APPLICATION_ID = 0x0FAC7501
"""Marks an SQLite file as ours (https://sqlite.org/fileformat.html, "Application ID")."""
BUSY_S = 1.0
"""How long to wait for another process that is writing."""
_SCHEMA = f"""
BEGIN;
CREATE TABLE fact (
    number INTEGER PRIMARY KEY, time_s REAL NOT NULL, kind TEXT NOT NULL, object TEXT NOT NULL,
    place TEXT NOT NULL);

-- Where an object was seen (or put) and said to be, less what is contradicted since. The triggers
-- belong to the transaction that adds the fact: a kill leaves both or neither.
CREATE TABLE belief (
    object TEXT NOT NULL, place TEXT NOT NULL, seen INTEGER NOT NULL, number INTEGER NOT NULL,
    PRIMARY KEY (object, place, seen)) WITHOUT ROWID;
CREATE INDEX belief_newest ON belief (object, number, place, seen);
CREATE TRIGGER is_there AFTER INSERT ON fact WHEN new.kind IN ('seen', 'put', 'said') BEGIN
    INSERT OR REPLACE INTO belief VALUES (new.object, new.place, new.kind != 'said', new.number);
END;
CREATE TRIGGER is_not_there AFTER INSERT ON fact WHEN new.kind = 'missed' BEGIN
    DELETE FROM belief WHERE object = new.object AND place = new.place;
END;
CREATE TRIGGER is_nowhere AFTER INSERT ON fact WHEN new.kind = 'taken' BEGIN
    DELETE FROM belief WHERE object = new.object;
END;

PRAGMA application_id = {APPLICATION_ID};
COMMIT;
"""


class FactKind(StrEnum):
    """What happened to an object at a place."""

    SEEN = "seen"
    MISSED = "missed"
    """Looked for, and not seen."""
    SAID = "said"
    """The person said that it is there."""
    TAKEN = "taken"
    """The robot picked it up there: it is nowhere now."""
    PUT = "put"
    """The robot put it down there."""


@dataclass(frozen=True, slots=True)
class Fact:
    """One fact; `time_s` is UTC (seconds since 1970)."""

    kind: FactKind
    object: str
    place: str
    time_s: float


class FactStore:
    """Implements `Facts` with an SQLite file, each fact one committed transaction.

    A process that is killed at any moment leaves every fact that it was told (write-ahead log).
    A disk that is full costs the fact and a warning, not the mission.
    """

    def __init__(
        self,
        file: Path | None = None,
        *,
        learns: bool = True,
        now: Callable[[], float] = time.time,
    ) -> None:
        """Open the file, or make it.

        Args:
            file: None: facts are kept until the process ends.
            learns: whether facts are added; if not, the file is only read.
            now: the time (UTC, s) that facts get.

        Raises:
            InputError: if the file cannot be opened or is something else.
        """
        self._learns = learns
        self._now = now
        self._database = _open(file)

    @classmethod
    def believing(cls, beliefs: Mapping[str, Sequence[str]], *, learns: bool = True) -> Self:
        """A store that lasts as long as the process and believes what another one did."""
        store = cls()
        for name, places in beliefs.items():
            store.heard(name, places)
        store._learns = learns
        return store

    # --- the Facts protocol ---

    def saw(self, names: Iterable[str], place: str) -> None:
        """These objects were seen there."""
        for name in names:
            self._add(FactKind.SEEN, name, place)

    def missed(self, name: str, place: str) -> None:
        """It was looked for there, and is not there."""
        self._add(FactKind.MISSED, name, place)

    def heard(self, name: str, places: Iterable[str]) -> None:
        """The person said that it is at one of these places, the likeliest first."""
        for place in reversed(tuple(places)):
            self._add(FactKind.SAID, name, place)

    def took(self, name: str, place: str) -> None:
        """The robot has it, from there."""
        self._add(FactKind.TAKEN, name, place)

    def put(self, name: str, place: str) -> None:
        """The robot has put it down there."""
        self._add(FactKind.PUT, name, place)

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where it was last seen or put; before that, where the person has since said that it is.

        A look in vain contradicts what was known before it about that place. Once taken, it is
        nowhere until seen again.
        """
        try:
            return self._believed(name)
        except sqlite3.Error as error:
            log.warning("facts about the %s could not be read: %s", name, error)
            return ()

    # --- for whoever keeps and shows them ---

    def beliefs(self) -> dict[str, tuple[str, ...]]:
        """Each object that is believed to be anywhere, and where."""
        names = self._database.execute("SELECT DISTINCT object FROM belief ORDER BY object")
        return {name: self.places_of(name) for (name,) in names.fetchall()}

    def all(self) -> tuple[Fact, ...]:
        """Every fact, oldest first."""
        rows = self._database.execute(
            "SELECT kind, object, place, time_s FROM fact ORDER BY number"
        )
        return tuple(Fact(FactKind(kind), *rest) for kind, *rest in rows)

    def load(self, facts: Iterable[Fact]) -> None:
        """Add facts with the times that they have."""
        rows = [(fact.time_s, fact.kind, fact.object, fact.place) for fact in facts]
        with self._database:
            self._database.executemany(
                "INSERT INTO fact (time_s, kind, object, place) VALUES (?, ?, ?, ?)", rows
            )

    def forget(self, name: str | None = None) -> int:
        """Remove the facts about one object, or all; return how many there were."""
        condition, values = ("", ()) if name is None else (" WHERE object = ?", (name,))
        with self._database:
            self._database.execute(f"DELETE FROM belief{condition}", values)
            return self._database.execute(f"DELETE FROM fact{condition}", values).rowcount

    def close(self) -> None:
        """Close the file."""
        self._database.close()

    def _believed(self, name: str) -> tuple[str, ...]:
        newest_first = self._database.execute(
            "SELECT place, seen FROM belief WHERE object = ? ORDER BY number DESC", (name,)
        )
        places: list[str] = []
        for place, seen in newest_first:
            places.append(place)
            if seen:
                break
        return tuple(dict.fromkeys(places))

    def _add(self, kind: FactKind, name: str, place: str) -> None:
        if not self._learns:
            return
        try:
            self.load((Fact(kind, name, place, self._now()),))
        except sqlite3.Error as error:
            log.warning("a fact could not be kept (%s %s %s): %s", name, kind, place, error)


def _open(file: Path | None) -> sqlite3.Connection:
    where = str(file or ":memory:")
    with ExitStack() as on_error:
        try:
            database = sqlite3.connect(where, timeout=BUSY_S)
            on_error.callback(database.close)
            _prepare(database)
        except sqlite3.Error as error:
            right = "name a file that --memory made, or one that does not exist yet"
            raise InputError(where, f"is no memory: {error}", right) from None
        on_error.pop_all()
    return database


def _prepare(database: sqlite3.Connection) -> None:
    """Make the table in an empty file; let no other file pass."""
    [[mark]] = database.execute("PRAGMA application_id")
    [[tables]] = database.execute("SELECT count(*) FROM sqlite_schema")
    if not mark and not tables:
        database.execute("PRAGMA journal_mode = WAL")
        database.executescript(_SCHEMA)
    elif mark != APPLICATION_ID:
        raise sqlite3.DatabaseError("it is a database of something else")
