"""A wire of small bandwidth: whoever passes through it shares that, chunk by chunk."""

import asyncio
import socket
import time
from contextlib import closing, suppress

from beside import Beside

CHUNK = 2048
BUFFER = 8192
"""So little waits on the way: what is sent waits with who sends it."""


class ThinWire(Beside):
    """Stands before a server, and lets so many bytes through in a second; `with` ends it."""

    def __init__(self, to: str, bytes_per_s: float) -> None:
        self.bytes_per_s = bytes_per_s
        """0: it is there, and nothing comes through any more."""
        self._to = to
        self._free_at = 0.0
        self._turn = asyncio.Lock()

    async def serve(self) -> None:
        async with await asyncio.start_server(self._pass, "127.0.0.1", 0, limit=BUFFER) as server:
            await self.listens(server.sockets[0].getsockname()[1])

    async def _pass(self, near: asyncio.StreamReader, nearer: asyncio.StreamWriter) -> None:
        host, port = self._to.removeprefix("ws://").split(":")
        with closing(nearer.transport), socket.socket() as to:
            to.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
            to.setblocking(False)
            await self._loop.sock_connect(to, (host, int(port)))
            far, farther = await asyncio.open_connection(sock=to, limit=BUFFER)
            try:
                await asyncio.gather(self._carry(near, farther), self._carry(far, nearer))
            finally:  # also when the wire ends
                for writer in (nearer, farther):
                    writer.transport.abort()

    async def _carry(self, one: asyncio.StreamReader, other: asyncio.StreamWriter) -> None:
        other.transport.set_write_buffer_limits(BUFFER)
        with suppress(ConnectionError):
            while chunk := await one.read(CHUNK):
                await self._wait_for(len(chunk))
                other.write(chunk)
                await other.drain()
            other.close()
            await other.wait_closed()

    async def _wait_for(self, size: int) -> None:
        async with self._turn:
            while not self.bytes_per_s:
                await asyncio.sleep(0.05)
            await asyncio.sleep(max(0.0, self._free_at - time.monotonic()))
            self._free_at = max(self._free_at, time.monotonic()) + size / self.bytes_per_s
