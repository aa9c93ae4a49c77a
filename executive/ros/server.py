"""The server side of the wire: a robot for any number of rosbridge clients.

It listens on one thread of its own. Whoever is behind it is told what is wanted there, at once, and
tells from any thread what happens.

A web page in a browser can reach every port of its own machine. So pages of other origins than this
machine are refused; and nobody else is listened to than this machine, unless the address says so.
"""

import asyncio
import contextlib
import logging
import os
import re
import threading
from collections.abc import Callable, Iterator
from typing import Any, Protocol

from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from executive.errors import InputError
from executive.ros.goals import Goal
from executive.ros.hub import Backend, Hub
from executive.ros.outbox import Letter, Outbox
from executive.ros.packets import Packet
from executive.ros.protocol import Compression, GoalStatus, Message, encode, encode_in_parts

LOOPBACK = "127.0.0.1"
MOST_CLIENTS = 32
MOST_BYTES = 2**22
"""Of one packet that a client sends."""
PING_S, LOST_S, CLOSE_S = 20.0, 120.0, 1.0
"""So often a client is asked whether it is there. It hears that after what it is sent before, which
may be a picture over a thin link."""
_THIS_MACHINE = re.compile(r"https?://(localhost|127\.0\.0\.1|\[::1\])(:\d+)?")
_BUSY, _TOO_SLOW = 1013, 1008
"""Codes with which a websocket is closed."""

_log = logging.getLogger(f"{__name__}.sockets")
_log.setLevel(logging.CRITICAL)  # that a stranger sends what is no websocket is no fault of ours


class Socket(Protocol):
    """Where it goes to."""

    async def send(self, packet: Packet, /) -> None:
        """Send this, as soon as there is room for it."""
        ...


class Server:
    """Serves a robot. All but `listen` and `close` may be called from any thread."""

    def __init__(self, backend: Backend, port: int, host: str = LOOPBACK) -> None:
        """Do nothing until `listen`; port 0: any that is free."""
        self._host, self._port = host, port
        self._hub = Hub(backend)
        self._ready = threading.Event()
        self._failure: OSError | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._over = asyncio.Event()
        self._thread = threading.Thread(target=self._run, name="server", daemon=True)

    @property
    def address(self) -> str:
        """Where clients find it."""
        return f"ws://{self._host}:{self._port}"

    def listen(self) -> None:
        """Begin.

        Raises:
            InputError: if the port cannot be had.
        """
        self._thread.start()
        self._ready.wait()
        if self._failure is not None:
            number = self._failure.errno
            why = os.strerror(number).lower() if number else str(self._failure)
            raise InputError(f"--port {self._port}", f"cannot listen: {why}", "give another one")

    def close(self) -> None:
        """Let everybody go."""
        if self._thread.is_alive():
            self._later(self._over.set)
            self._thread.join()

    # --- what happens ---

    def publish(self, topic: str, message: Message) -> None:
        """Tell a message to all who want it."""
        self._later(self._hub.publish, topic, message)

    def accept(self, goal: Goal, time_ns: int) -> None:
        """A goal is pursued, since this time of the robot (ns)."""
        self._later(setattr, goal, "accepted_ns", time_ns)

    def refuse(self, goal: Goal, why: str) -> None:
        """A goal is not pursued."""
        self._later(self._hub.refuse, goal, why)

    def feedback(self, goal: Goal, values: Message) -> None:
        """How a goal gets on."""
        self._later(self._hub.feedback, goal, values)

    def end(self, goal: Goal, status: GoalStatus, values: Message) -> None:
        """A goal ended."""
        self._later(self._hub.end, goal, status, values)

    def _later(self, call: Callable[..., object], *args: Any) -> None:
        if self._loop is not None:
            with contextlib.suppress(RuntimeError):  # it is closed: nobody is there any more
                self._loop.call_soon_threadsafe(call, *args)

    # --- on the server's thread ---

    def _run(self) -> None:
        try:
            asyncio.run(self._serve())
        finally:
            self._ready.set()

    async def _serve(self) -> None:
        self._loop = asyncio.get_running_loop()
        try:
            server = await serve(
                self._talk,
                self._host,
                self._port,
                origins=[None, _THIS_MACHINE],
                compression=None,
                max_size=MOST_BYTES,
                ping_interval=PING_S,
                ping_timeout=LOST_S,
                close_timeout=CLOSE_S,
                logger=_log,
            )
        except OSError as error:
            self._failure = error
            return
        async with server:
            self._port = next(iter(server.sockets)).getsockname()[1]
            self._ready.set()
            await self._over.wait()

    async def _talk(self, socket: ServerConnection) -> None:
        if len(self._hub) >= MOST_CLIENTS:
            await socket.close(_BUSY, f"more than {MOST_CLIENTS} clients")
            return
        outbox = Outbox()
        conversation = self._hub.join(outbox)
        sending = asyncio.create_task(send_from(outbox, socket))
        try:
            async for packet in socket:
                conversation.take(packet)
                if outbox.is_too_full:
                    await socket.close(_TOO_SLOW, "you read too slowly")
                await asyncio.sleep(0)  # others have their turn, however much this one sends
        except ConnectionClosed:
            pass
        finally:
            sending.cancel()
            self._hub.part(conversation)


async def send_from(outbox: Outbox, socket: Socket) -> None:
    """Send what is put into the outbox, in its order."""
    number = 0
    with contextlib.suppress(ConnectionClosed):
        while True:
            number += 1
            for packet in _packets(await outbox.take(), number):
                await socket.send(packet)
                await asyncio.sleep(0)  # a picture may be a million parts: others have their turn


def _packets(letter: Letter, number: int) -> Iterator[Packet]:
    if letter.compression != Compression.NONE:
        return iter((encode(letter.operation, letter.compression),))
    return encode_in_parts(letter.operation, f"fragment:{number}", letter.fragment_size)
