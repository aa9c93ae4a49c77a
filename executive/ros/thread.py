"""The thread on which everything happens that goes over the wire.

The thread that ticks starts things here and goes on; their ends are posted to the inbox.
"""

import asyncio
import threading
from collections.abc import Coroutine
from concurrent.futures import Future
from typing import Any, TypeVar

T = TypeVar("T")

LEAVING_S = 1.0
"""The longest that the end of a program waits for what is under way here."""


class WireThread:
    """An event loop on a thread of its own, which holds up nobody."""

    def __init__(self) -> None:
        """Begin."""
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._run, name="wire", daemon=True)
        self._thread.start()

    @property
    def loop(self) -> asyncio.AbstractEventLoop:
        """Where callbacks of other threads are to be put."""
        return self._loop

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        try:
            self._loop.run_forever()
        finally:
            self._loop.close()

    def start(self, work: Coroutine[Any, Any, T]) -> "Future[T]":
        """Begin this, and return at once."""
        return asyncio.run_coroutine_threadsafe(work, self._loop)

    def run(self, work: Coroutine[Any, Any, T]) -> T:
        """Do this, and wait for it; never called on the thread that ticks.

        Raises:
            Exception: what the work raises.
        """
        return self.start(work).result()

    def close(self) -> None:
        """Give up what is under way, and end the thread."""
        if not self._thread.is_alive():
            return
        asyncio.run_coroutine_threadsafe(self._leave(), self._loop)
        self._thread.join(LEAVING_S)

    async def _leave(self) -> None:
        tasks = [t for t in asyncio.all_tasks() if t is not asyncio.current_task()]
        for task in tasks:
            task.cancel()
        await asyncio.wait(tasks, timeout=LEAVING_S / 2) if tasks else None
        self._loop.stop()
