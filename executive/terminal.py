"""Safe standard output and error: control characters are escaped, and a lost stream is handled.

Values from outside are made printable where they are put into a sentence; this is a second line of
defence.
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
"""How long (s) a hurried stream waits for its reader."""
WIDTH = 78
"""Width, in columns, of a progress line that overwrites the one before."""


class Terminal:
    """A stream that escapes control characters, and characters that its encoding lacks.

    If the stream is lost (terminal or pipe closed, disk full), it raises BrokenPipeError once, with
    the cause, unless it is `dispensable`. Later output is discarded.
    """

    def __init__(self, stream: TextIO | None, *, dispensable: bool) -> None:
        """Write to this stream; if it is None, as for closed streams, discard the output."""
        self._stream = stream
        self.dispensable = dispensable
        self.hurried = False
        """Whether to skip output that would block (a terminal under Ctrl-S, a full pipe)."""
        self.lost = ""
        """Why the stream was lost; empty if it was not."""
        self.encoding: str = getattr(stream, "encoding", None) or "utf-8"
        """The encoding of the stream; ASCII in a terminal that supports nothing else."""

    def write(self, text: str) -> int:
        """Write text; control characters other than line breaks and tabs are escaped."""
        shown = "\n".join("\t".join(map(printable, line.split("\t"))) for line in text.split("\n"))
        self.write_raw(shown)
        return len(text)

    def write_raw(self, text: str) -> None:
        """Write text without escaping, for the program's own control sequences."""
        if self._stream is None or (self.hurried and not self._has_room()):
            return
        encoded = text.encode(self.encoding, "backslashreplace").decode(self.encoding)
        try:
            self._stream.write(encoded)
        except (OSError, ValueError) as error:
            self._lose(error)

    def write_line(self, text: str, color: int) -> None:
        """Write a line, in a colour (an SGR code of ECMA-48) if the terminal shows colours."""
        if self.is_seen() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb":
            self.write_raw(f"\x1b[{color}m{printable(text)}\x1b[0m\n")
        else:
            self.write(f"{printable(text)}\n")

    def flush(self) -> None:
        """Flush the stream."""
        if self._stream is None:
            return
        try:
            self._stream.flush()
        except (OSError, ValueError) as error:
            self._lose(error)

    def fileno(self) -> int:
        """The file descriptor."""
        if self._stream is None:
            raise io.UnsupportedOperation("closed")
        return self._stream.fileno()

    def isatty(self) -> bool:
        """False, so that libraries do not write colours, which would be escaped."""
        return False

    @property
    def screen(self) -> TextIO | None:
        """The underlying stream, for a library that draws on a terminal; None if it is lost."""
        return self._stream

    def is_seen(self) -> bool:
        """Whether the underlying stream is a terminal, and not a file or a pipe."""
        return self._stream is not None and self._stream.isatty()

    def _has_room(self) -> bool:
        try:
            return bool(select([], [self.fileno()], [], ROOM_S)[1])
        except (OSError, ValueError):
            return True

    def _lose(self, error: Exception) -> None:
        with suppress(OSError, ValueError):  # buffered output goes to /dev/null
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.fileno())
        self._stream = None
        self.lost = getattr(error, "strerror", None) or str(error)
        if not self.dispensable and isinstance(error, OSError):
            raise BrokenPipeError(error.errno, error.strerror) from None


@contextmanager
def standard_streams() -> Iterator[None]:
    """Replace `sys.stdout` and `sys.stderr` by `Terminal` streams inside the block."""
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
    """Open closed standard streams to /dev/null.

    Otherwise the next opened file, such as a log, would get the descriptor, and what a C library
    writes to standard error would go into it.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # gets the lowest free descriptor


def show_over(line: str, out: TextIO | None = None) -> None:
    """Show a progress line that overwrites the one before (default: on standard error).

    In a file or a pipe, it is a line of its own.
    """
    out = out or sys.stderr
    if isinstance(out, Terminal) and out.is_seen():
        out.write_raw(f"\r{printable(line):<{WIDTH}}" + "\r" * (not line))
    elif line:
        out.write(f"{printable(line)}\n")
    out.flush()
