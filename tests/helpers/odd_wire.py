"""A websocket between two that does what networks do: it delays, cuts, halves and reorders."""

import asyncio
import random
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from beside import Beside
from websockets.asyncio.client import connect
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

LARGEST = 2**25


@dataclass
class Mischief:
    """How often (0 to 1) each message meets with what; delays are at most so long (s)."""

    delay: float = 0.0
    cut: float = 0.0
    halve: float = 0.0
    swap: float = 0.0
    delay_s: float = 0.05


@dataclass
class OddWire(Beside):
    """Stands before a server; `with` ends it."""

    to: str
    seed: int = 0
    mischief: Mischief = field(default_factory=Mischief)
    cuts: int = 0
    passing: int = 0
    """So many connections pass through now."""

    def __post_init__(self) -> None:
        self._chance = random.Random(self.seed)

    @property
    def is_whole(self) -> bool:
        """Whether a robot's link passes through, with both of its sockets."""
        return self.passing >= 2

    async def serve(self) -> None:
        options: dict[str, Any] = {"compression": None, "max_size": LARGEST}
        async with serve(self._pass, "127.0.0.1", 0, **options) as server:
            await self.listens(next(iter(server.sockets)).getsockname()[1])

    async def _pass(self, here: ServerConnection) -> None:
        with suppress(OSError, ConnectionClosed):
            async with connect(self.to, compression=None, max_size=LARGEST, proxy=None) as there:
                self.passing += 1
                ways = [
                    asyncio.create_task(self._carry(here, there)),
                    asyncio.create_task(self._carry(there, here)),
                ]
                await asyncio.wait(ways, return_when=asyncio.FIRST_COMPLETED)
                self.passing -= 1
                for way in ways:
                    way.cancel()
                await asyncio.gather(*ways, return_exceptions=True)
                here.transport.abort()

    async def _carry(self, one: Any, other: Any) -> None:
        """Until something cuts it."""
        kept: str | bytes | None = None
        async for packet in one:
            said_now, held_back = self._meddled(packet, kept)
            for said in said_now:
                if said is None:
                    self.cuts += 1
                    return
                if self._happens(self.mischief.delay):
                    await asyncio.sleep(self._chance.uniform(0, self.mischief.delay_s))
                await other.send(said)
            kept = packet if held_back else None

    def _meddled(self, packet: Any, kept: Any) -> tuple[list[Any], bool]:
        """What becomes of a packet, None is a cut; and whether it comes after the next one."""
        if self._happens(self.mischief.cut):
            return [None], False
        if self._happens(self.mischief.halve):
            packet = packet[: len(packet) // 2]
        if kept is not None:
            return [packet, kept], False
        if self._happens(self.mischief.swap):
            return [], True
        return [packet], False

    def _happens(self, often: float) -> bool:
        return self._chance.random() < often
