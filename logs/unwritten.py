"""A record that does not fit costs that record, and is told once for each kind."""

import logging

from executive.records import Note
from executive.text import printable

log = logging.getLogger(__name__)


class Unwritten:
    """What one sink could not write down."""

    def __init__(self, sink: str) -> None:
        """Tell of the sink of this name."""
        self._sink = sink
        self._told: set[str] = set()

    def note(self, kind: str, error: Exception) -> Note | None:
        """What to write in place of a record of this kind; None if the kind was told before."""
        if kind in self._told:
            return None
        self._told.add(kind)
        why = printable(f"{type(error).__name__}: {error}")
        text = f"a record of kind {kind} could not be written by {self._sink}: {why}"
        log.warning(text)
        return Note("warning", text)
