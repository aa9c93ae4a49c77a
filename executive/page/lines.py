"""What a page sends, as the lines of a terminal: so the person at a page is one at a console.

Whatever a console makes of words (a stop, a command, an answer, or nothing because nobody asks)
is made of those of a page, too.
"""

import io
import queue
from collections.abc import Callable

from executive.text import LONGEST, writable


class Lines(io.TextIOBase):
    """The terminal's keyboard: `put` types a line, from any thread."""

    def __init__(self) -> None:
        """Nothing is typed yet."""
        self._typed: queue.SimpleQueue[str] = queue.SimpleQueue()

    def isatty(self) -> bool:
        """A person types, and sees what was asked before they do."""
        return True

    def put(self, words: str) -> None:
        """Type words and press Enter. Of what is too long, enough is kept to be refused."""
        self._typed.put(" ".join(writable(words).splitlines())[: LONGEST + 1] + "\n")

    def readline(self, size: int | None = -1, /) -> str:  # type: ignore[override]
        """The next line, as soon as there is one; none is longer than a console reads at once."""
        return self._typed.get()


class Said(io.TextIOBase):
    """The terminal's screen: each line that is printed is given to a function."""

    def __init__(self, show: Callable[[str], None]) -> None:
        """Give the lines to this function."""
        self._show = show
        self._line = ""

    def write(self, text: str, /) -> int:
        """Print it."""
        *lines, self._line = (self._line + text).split("\n")
        for line in lines:
            self._show(line)
        return len(text)
