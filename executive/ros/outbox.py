"""What waits to be sent to one client. Of a topic only the newest message does.

An end or an answer is never passed: how it was before that, is told before that.
"""

import asyncio
from collections import OrderedDict
from collections.abc import Hashable
from dataclasses import dataclass

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
        self._waiting: OrderedDict[tuple[int, Hashable], Letter] = OrderedDict()
        self._filled = asyncio.Event()
        self._last = 0

    def put(self, letter: Letter, newest_of: Hashable = None) -> None:
        """Send it after all that waits.

        One that is the newest of something replaces those that came since the last that is not.
        """
        if newest_of is None:
            self._last += 1
        key = (self._last, newest_of)
        self._waiting.pop(key, None)
        self._waiting[key] = letter
        self._filled.set()

    def forget(self, newest_of: Hashable) -> None:
        """It is not wanted any more."""
        for key in [key for key in self._waiting if key[1] == newest_of]:
            del self._waiting[key]

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
