"""What waits to be sent to one client. Of a topic only the newest message does."""

import asyncio
from collections import OrderedDict
from collections.abc import Hashable
from dataclasses import dataclass
from itertools import count

from executive.ros.protocol import Operation

MOST_WAITING = 2000
"""So many messages may wait; a client that reads slower than that is let go."""


@dataclass(frozen=True, slots=True)
class Letter:
    """An operation, and how its reader wants it packed."""

    operation: Operation
    compression: str = "none"
    fragment_size: int | None = None


class Outbox:
    """Belongs to the thread of the server's event loop."""

    def __init__(self) -> None:
        """Nothing waits."""
        self._waiting: OrderedDict[Hashable, Letter] = OrderedDict()
        self._filled = asyncio.Event()
        self._numbers = count()

    def put(self, letter: Letter, newest_of: Hashable = None) -> None:
        """Send it after all that waits; it takes the place of an older one of the same kind."""
        key: Hashable = next(self._numbers) if newest_of is None else ("newest", newest_of)
        self._waiting.pop(key, None)
        self._waiting[key] = letter
        self._filled.set()

    def forget(self, newest_of: Hashable) -> None:
        """It is not wanted any more."""
        self._waiting.pop(("newest", newest_of), None)

    @property
    def is_too_full(self) -> bool:
        """Whether its reader is too slow."""
        return len(self._waiting) > MOST_WAITING

    async def take(self) -> Letter:
        """The next that is to be sent; waits for one."""
        while not self._waiting:
            self._filled.clear()
            await self._filled.wait()
        return self._waiting.popitem(last=False)[1]
