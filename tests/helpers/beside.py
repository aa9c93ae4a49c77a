"""A server of the tests' own, on a thread beside them."""

import asyncio
import threading
from typing import Self

from patience import PATIENCE_S


class Beside:
    """Serves at `url` while its `with` lasts, and gives up then what still goes on."""

    port = 0

    def __enter__(self) -> Self:
        self._loop = asyncio.new_event_loop()
        self._over = asyncio.Event()
        self._started = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        assert self._started.wait(PATIENCE_S)
        return self

    def __exit__(self, *_: object) -> None:
        self._loop.call_soon_threadsafe(self._over.set)
        self._thread.join(PATIENCE_S)

    @property
    def url(self) -> str:
        return f"ws://127.0.0.1:{self.port}"

    async def serve(self) -> None:
        """Listen, tell so by `listens`, and go on until that ends."""
        raise NotImplementedError

    async def listens(self, port: int) -> None:
        """It is there, at this port; returns when it is to end."""
        self.port = port
        self._started.set()
        await self._over.wait()

    def _run(self) -> None:
        with asyncio.Runner(loop_factory=lambda: self._loop) as runner:
            runner.run(self.serve())
