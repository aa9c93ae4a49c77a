"""Long messages in parts: rosbridge's `fragment`."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from executive.ros.packets import MOST_BYTES, PacketError

MOST_PARTS = 100_000
MOST_OPEN = 16
"""So many messages may be incomplete at once; the oldest of more is given up."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a message's text: which of how many."""

    id: str
    data: str
    num: int
    total: int


def split(text: str, size: int, id: str) -> Iterator[Part]:
    """The text in parts of so many characters at most; each is made when its turn comes.

    Raises:
        ValueError: if the size is not positive.
    """
    if size < 1:
        raise ValueError("a part has at least one character")
    total = max(1, math.ceil(len(text) / size))
    return (Part(id, text[n * size : (n + 1) * size], n, total) for n in range(total))


@dataclass
class _Incomplete:
    total: int
    pieces: dict[int, str] = field(default_factory=dict)
    length: int = 0


class Joiner:
    """Puts parts together again, in whichever order they come."""

    def __init__(self) -> None:
        """Nothing has come."""
        self._open: dict[str, _Incomplete] = {}

    def add(self, part: Part) -> str | None:
        """The whole text if this was the last part that lacked.

        Raises:
            PacketError: if it does not fit the parts before; that message is given up.
        """
        if not (0 <= part.num < part.total <= MOST_PARTS):
            raise PacketError(f"part {part.num} of {part.total} of a message")
        begun = self._open.setdefault(part.id, _Incomplete(part.total))
        if begun.pieces.get(part.num, part.data) != part.data or begun.total != part.total:
            del self._open[part.id]
            raise PacketError("parts of a message that do not belong together")
        if part.num not in begun.pieces:
            begun.length += len(part.data)
        begun.pieces[part.num] = part.data
        if len(begun.pieces) == begun.total:
            del self._open[part.id]
            return "".join(begun.pieces[number] for number in range(begun.total))
        self._bound(part.id)
        return None

    def _bound(self, newest: str) -> None:
        """Keep what is incomplete within bounds."""
        if sum(begun.length for begun in self._open.values()) > MOST_BYTES:
            del self._open[newest]
            raise PacketError(f"parts of messages of more than {MOST_BYTES:,} characters")
        if len(self._open) > MOST_OPEN:
            del self._open[next(iter(self._open))]
