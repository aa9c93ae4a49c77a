"""The past runs in a folder: which there are, found by words and by how they ended."""

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from executive.errors import InputError
from executive.text import printable
from logs.recording.reader import FILE_NAME

MOST = 200
"""So many are listed at once, the latest first."""
UNFINISHED = "unfinished"
"""How a run is called that goes on, or was killed: nothing says how it ended."""
OUTCOME = "outcome.json"
MOST_BYTES = 1_000_000
LONGEST = 300

Row = dict[str, Any]


class Runs:
    """The runs of a folder. What is known of a run is read once, unless its outcome changes."""

    def __init__(self, folder: Path) -> None:
        """Look in this folder; it need not be there."""
        self._folder = folder
        self._rows: dict[str, tuple[int, Row]] = {}

    def path(self, name: str) -> Path:
        """A run's folder.

        Raises:
            InputError: if there is no such run.
        """
        folder = self._folder / name
        if name != Path(name).name or name in ("", ".", "..") or not (folder / FILE_NAME).is_file():
            raise InputError("run", "there is no such run")
        return folder

    def found(self, words: str = "", status: str = "") -> dict[str, Any]:
        """Those in which all these words are, and that ended so; how many of how many there are."""
        rows = [row for name in self._names() if (row := self._row(name))]
        wanted = words.lower().split()
        found = [r for r in rows if status in ("", r["status"]) and _has(r, wanted)]
        return {
            "runs": found[:MOST],
            "found": len(found),
            "all": len(rows),
            "statuses": sorted({row["status"] for row in rows}),
        }

    def _names(self) -> Iterator[str]:
        """The latest first: names begin with the time."""
        try:
            folders = [entry.name for entry in self._folder.iterdir()]
        except OSError:
            return iter(())
        return iter(sorted(folders, reverse=True))

    def _row(self, name: str) -> Row | None:
        folder = self._folder / name
        try:
            changed = (folder / OUTCOME).stat().st_mtime_ns
        except OSError:
            changed = 0
        known = self._rows.get(name)
        if known is None or known[0] != changed:
            if not (folder / FILE_NAME).is_file():
                return None
            known = self._rows[name] = changed, _read(folder)
        return known[1]


def _read(folder: Path) -> Row:
    try:
        with (folder / OUTCOME).open("rb") as file:
            told = json.loads(file.read(MOST_BYTES))
    except (OSError, ValueError, RecursionError):
        told = {}
    told = told if isinstance(told, dict) else {}
    seconds, asked = told.get("mission_time_s"), told.get("inquiries")
    return {
        "run": folder.name,
        "command": _text(told.get("command")),
        "status": _text(told.get("status")) or UNFINISHED,
        "reason": _text(told.get("reason")),
        "object": _text(told.get("object")),
        "place": _text(told.get("location")),
        "visited": [_text(place) for place in _list(told.get("visited"))][:50],
        "time_s": seconds if isinstance(seconds, int | float) else None,
        "asked": asked if isinstance(asked, int) else None,
    }


def _text(value: object) -> str:
    return printable(value[:LONGEST]) if isinstance(value, str) else ""


def _list(value: object) -> Iterable[object]:
    return value if isinstance(value, list) else ()


def _has(row: Row, wanted: Iterable[str]) -> bool:
    named = ("run", "command", "status", "reason", "object", "place")
    told = " ".join((*(row[key] for key in named), *row["visited"])).lower().replace("_", " ")
    return all(word.replace("_", " ") in told for word in wanted)
