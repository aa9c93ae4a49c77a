"""Standard output and error as programs may use them: nothing printed harms, no loss of them hurts.

Values from outside are made printable where they are put into a sentence; this is the net below.
"""

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from select import select
from typing import TextIO, cast

from executive.text import printable

ROOM_S = 0.05
"""How long a hurried stream waits for a reader."""
WIDTH = 78
"""Columns of a line that is written over the one before."""


class Terminal:
    """A stream that spells out what a terminal would obey or cannot show.

    If it is lost (the terminal or the pipe closed, the disk full), that is a BrokenPipeError once,
    with what it was, unless the stream is `dispensable`; what is written later goes nowhere.
    """

    def __init__(self, stream: TextIO | None, *, dispensable: bool) -> None:
        """Write to this stream; to nowhere if it is None, as Python has it when it was closed."""
        self._stream = stream
        self.dispensable = dispensable
        self.hurried = False
        """Whether what would have to wait (a terminal under Ctrl-S, a full pipe) is left out."""
        self.lost = ""
        """Why nothing more is written; empty if it is."""
        self.encoding: str = getattr(stream, "encoding", None) or "utf-8"
        """How text is written as bytes; ASCII in a terminal that knows no other."""

    def write(self, text: str) -> int:
        """Write it, with every control character but line breaks and tabs spelled out."""
        shown = "\n".join("\t".join(map(printable, line.split("\t"))) for line in text.split("\n"))
        self.write_raw(shown)
        return len(text)

    def write_raw(self, text: str) -> None:
        """Write what the program itself wants a terminal to obey."""
        if self._stream is None or (self.hurried and not self._has_room()):
            return
        encoded = text.encode(self.encoding, "backslashreplace").decode(self.encoding)
        try:
            self._stream.write(encoded)
        except (OSError, ValueError) as error:
            self._lose(error)

    def write_line(self, text: str, color: int) -> None:
        """Write a line; in a colour (an SGR code of ECMA-48) if somebody sees colours."""
        if self.is_seen() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb":
            self.write_raw(f"\x1b[{color}m{printable(text)}\x1b[0m\n")
        else:
            self.write(f"{printable(text)}\n")

    def flush(self) -> None:
        """Have it written."""
        if self._stream is None:
            return
        try:
            self._stream.flush()
        except (OSError, ValueError) as error:
            self._lose(error)

    def fileno(self) -> int:
        """The number of the file."""
        if self._stream is None:
            raise io.UnsupportedOperation("closed")
        return self._stream.fileno()

    def isatty(self) -> bool:
        """No: what libraries write to terminals only, such as colours, it would spell out."""
        return False

    @property
    def screen(self) -> TextIO | None:
        """The stream below, for a library that draws on a terminal; None if it is lost."""
        return self._stream

    def is_seen(self) -> bool:
        """Whether somebody sees it as it is written: it is a terminal, and not a file or a pipe."""
        return self._stream is not None and self._stream.isatty()

    def _has_room(self) -> bool:
        try:
            return bool(select([], [self.fileno()], [], ROOM_S)[1])
        except (OSError, ValueError):
            return True

    def _lose(self, error: Exception) -> None:
        with suppress(OSError, ValueError):  # what waits to be written is written, to nowhere
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.fileno())
        self._stream = None
        self.lost = getattr(error, "strerror", None) or str(error)
        if not self.dispensable and isinstance(error, OSError):
            raise BrokenPipeError(error.errno, error.strerror) from None


@contextmanager
def standard_streams() -> Iterator[None]:
    """Have `sys.stdout` and `sys.stderr` be such streams meanwhile."""
    before = sys.stdout, sys.stderr
    if not isinstance(sys.stdout, Terminal):
        sys.stdout = cast(TextIO, Terminal(sys.stdout, dispensable=False))
    if not isinstance(sys.stderr, Terminal):
        sys.stderr = cast(TextIO, Terminal(sys.stderr, dispensable=True))
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


def open_closed_files() -> None:
    """Have standard input, output and error be open, to nowhere if they were closed.

    Otherwise the next file that is opened, such as a log, would get their number, and what a
    library writes in C to standard error would go into it.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # gets the lowest number that is free


def show_over(line: str, out: TextIO | None = None) -> None:
    """Show a line of progress in place of the one before it (default: on standard error).

    In a file or a pipe, where nothing is over another, it is a line of its own.
    """
    out = out or sys.stderr
    if isinstance(out, Terminal) and out.is_seen():
        out.write_raw(f"\r{printable(line):<{WIDTH}}" + "\r" * (not line))
    elif line:
        out.write(f"{printable(line)}\n")
    out.flush()
