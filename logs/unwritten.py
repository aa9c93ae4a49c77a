"""A record that cannot be written is skipped; this is reported once for each kind of record."""

import logging

from executive.records import Note
from executive.text import printable

log = logging.getLogger(__name__)


class Unwritten:
    """Records that one sink could not write."""

    def __init__(self, sink: str) -> None:
        """`sink` is the name to report."""
        self._sink = sink
        self._told: set[str] = set()

    def note(self, kind: str, error: Exception) -> Note | None:
        """Warn, and return the note to write instead; None if this kind was reported before."""
        if kind in self._told:
            return None
        self._told.add(kind)
        why = printable(f"{type(error).__name__}: {error}")
        text = f"a record of kind {kind} could not be written by {self._sink}: {why}"
        log.warning(text)
        return Note("warning", text)
