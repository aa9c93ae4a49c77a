"""Opens the SQLite file of facts: creates it if need be, and refuses a file that is not ours.

Several processes may do so at once.
"""

import os
import sqlite3
from contextlib import ExitStack, closing, suppress
from functools import cache
from pathlib import Path

from executive.errors import InputError
from executive.text import printable

APPLICATION_ID = 0x0FAC7501
"""Marks an SQLite file as ours (https://sqlite.org/fileformat.html, "Application ID")."""
BUSY_S = 0.25
"""How long to wait for another process that is writing (s); short, because a stop waits, too."""
OPENING_S = 10.0
"""The same while the file is opened: another process may be creating it."""
MOST_CHECKED = 16 * 1024 * 1024
"""Files of up to this many bytes are checked for damage when they are opened."""
_BESIDE = ("-journal", "-wal", "-shm")
"""Endings of the files that SQLite opens beside it."""
MOST_BYTES = 1_000_000
"""The largest text or row that SQLite reads."""

_SCHEMA = (
    """CREATE TABLE fact (
    number INTEGER PRIMARY KEY, time_s REAL NOT NULL, kind TEXT NOT NULL, object TEXT NOT NULL,
    place TEXT NOT NULL)""",
    # Where an object was seen (or put) and said to be, without what was contradicted since. The
    # triggers run in the transaction that adds the fact: a kill leaves both or neither.
    """CREATE TABLE belief (
    object TEXT NOT NULL, place TEXT NOT NULL, seen INTEGER NOT NULL, number INTEGER NOT NULL,
    PRIMARY KEY (object, place, seen)) WITHOUT ROWID""",
    "CREATE INDEX belief_newest ON belief (object, number, place, seen)",
    """CREATE TRIGGER is_there AFTER INSERT ON fact WHEN new.kind IN ('seen', 'put', 'said') BEGIN
    INSERT OR REPLACE INTO belief VALUES (new.object, new.place, new.kind != 'said', new.number);
END""",
    """CREATE TRIGGER is_not_there AFTER INSERT ON fact WHEN new.kind = 'missed' BEGIN
    DELETE FROM belief WHERE object = new.object AND place = new.place;
END""",
    """CREATE TRIGGER is_nowhere AFTER INSERT ON fact WHEN new.kind = 'taken' BEGIN
    DELETE FROM belief WHERE object = new.object;
END""",
    f"PRAGMA application_id = {APPLICATION_ID}",
)
"""A file with any other definition in it, such as a strange trigger or view, is refused."""


def opened(file: Path | None, *, learns: bool) -> sqlite3.Connection:
    """Open a file of facts, or create it.

    Args:
        file: the file; None for a database in memory.
        learns: whether facts will be added.

    Raises:
        InputError: if the file cannot be opened, is something else, or cannot be written although
            facts will be added.
    """
    with ExitStack() as on_error:
        try:
            database = _connect(file, learns)
            on_error.callback(database.close)
            _distrust(database)
            _prepare(database)
            if file is not None and file.stat().st_size <= MOST_CHECKED:
                _check(database)
            if learns:
                database.execute("DELETE FROM fact WHERE 0")  # raises if it can only be read
                database.rollback()
            database.execute("PRAGMA synchronous = NORMAL")  # no fact waits for the disk
            database.execute(f"PRAGMA busy_timeout = {round(BUSY_S * 1000)}")
        except (sqlite3.Error, OSError, ValueError) as error:
            right = "name a file that --memory made, or one that does not exist yet"
            if "readonly" in str(error):
                right = "let it be written, or add --no-learn"
            elif "unable to open" in str(error):
                right = "name a file in a folder that is there and may be written"
            raise InputError(printable(file), f"is no memory: {printable(error)}", right) from None
        on_error.pop_all()
    return database


def _connect(file: Path | None, learns: bool) -> sqlite3.Connection:
    if file is None:
        return sqlite3.connect(":memory:")
    if file.exists() and not file.is_file():
        raise sqlite3.DatabaseError("it is no file")
    for beside in (Path(f"{file}{ending}") for ending in _BESIDE):
        if beside.exists() and not beside.is_file():  # SQLite would wait for a pipe for ever
            raise sqlite3.DatabaseError(f"{beside.name} beside it is no file")
    if not learns and not os.access(file.parent, os.W_OK):
        # SQLite cannot put its own files beside it, and needs none for a file that does not change
        return sqlite3.connect(f"{file.absolute().as_uri()}?immutable=1", uri=True)
    return sqlite3.connect(str(file.absolute()), timeout=OPENING_S)


def _distrust(database: sqlite3.Connection) -> None:
    """Let no code in a file of others run, and limit the size of what is read."""
    database.text_factory = lambda text: text.decode(errors="replace")
    database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, MOST_BYTES)
    database.execute("PRAGMA trusted_schema = OFF")
    database.execute("PRAGMA cell_size_check = ON")


def _prepare(database: sqlite3.Connection) -> None:
    """Create the tables in an empty file; refuse any other file that is not ours."""
    if _is_empty(database):
        database.execute("BEGIN IMMEDIATE")  # other processes wait here, then find the tables
        with database:
            if _is_empty(database):
                for statement in _SCHEMA:
                    database.execute(statement)
        with suppress(sqlite3.OperationalError):  # another process is doing it
            database.execute("PRAGMA journal_mode = WAL")
    if _application_id(database) != APPLICATION_ID or _definitions(database) != _ours():
        raise sqlite3.DatabaseError("it is a database of something else")


def _is_empty(database: sqlite3.Connection) -> bool:
    return not _application_id(database) and not _definitions(database)


def _application_id(database: sqlite3.Connection) -> int:
    [[mark]] = database.execute("PRAGMA application_id")
    return int(mark)


def _definitions(database: sqlite3.Connection) -> list[tuple[object, ...]]:
    """All definitions in a file, as text: they are compared, never run."""
    query = "SELECT type, name, tbl_name, sql FROM sqlite_schema ORDER BY type, name LIMIT 99"
    return database.execute(query).fetchall()


@cache
def _ours() -> list[tuple[object, ...]]:
    with closing(sqlite3.connect(":memory:")) as database:
        for statement in _SCHEMA:
            database.execute(statement)
        return _definitions(database)


def _check(database: sqlite3.Connection) -> None:
    [[found]] = database.execute("PRAGMA quick_check(1)")
    if found != "ok":
        raise sqlite3.DatabaseError(f"it is damaged: {found}")
