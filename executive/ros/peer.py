"""One websocket that speaks rosbridge: connected again whenever it was lost.

What was asked over it ends: with an answer, or with a `LinkError` when the connection does.
"""

import asyncio
import logging
from collections.abc import Callable
from contextlib import suppress
from itertools import count
from typing import Any

from websockets.asyncio.client import ClientConnection, connect

from executive.guards import in_words
from executive.ros.address import Address
from executive.ros.fragments import Joiner
from executive.ros.link import LinkError, Receive
from executive.ros.packets import MOST_BYTES, PacketError
from executive.ros.profile import COMPRESSED, IMAGE
from executive.ros.protocol import (
    ActionFeedback,
    ActionResult,
    Compression,
    Fragment,
    Operation,
    Publish,
    ServiceResponse,
    Status,
    Subscribe,
    Unsubscribe,
    decode,
    encode,
)
from executive.ros.reasons import why_lost
from executive.text import printable

CONNECTING_S = 5.0
PING_S, SILENT_S = 2.0, 8.0
"""How often the other side is asked whether it is there, and after how long without a byte of it
there is no connection any more."""
AGAIN_S = (0.1, 0.2, 0.5, 1.0)
"""Pauses between attempts to connect; the last one again and again."""
PACKED = (IMAGE, COMPRESSED, "sensor_msgs/msg/PointCloud2")
"""Types that come as CBOR. Others do not: a rosbridge of before March 2026 cannot pack arrays of a
fixed length, which odometry and lenses have, and then sends nothing."""
MOST_WAITING = 1000
"""So many messages may wait to be sent; more, and the other side does not read any more."""

log = logging.getLogger(__name__)


class _Door(connect):
    """Goes nowhere else than where it was told: what headers hold is meant for that host alone."""

    def process_redirect(self, exc: Exception) -> Exception:
        """Why it was not let in; a redirect is not followed."""
        return exc


class _Connection(ClientConnection):
    """Knows when anything was heard of the other side.

    Over a thin link the answer to a ping comes after the picture that is on its way.
    """

    heard_at = 0.0

    def data_received(self, data: bytes) -> None:
        """Some bytes, which may be a part of a message."""
        self.heard_at = self.loop.time()
        super().data_received(data)


class Peer:
    """The other side of one websocket. All of it belongs to the thread of the wire."""

    def __init__(self, address: Address, name: str, changed: Callable[[], None]) -> None:
        """Not connected yet.

        Args:
            address: where it is.
            name: what messages call this connection, and how ids begin.
            changed: called when it is connected, and when that is lost.
        """
        self.loss = "it is not connected yet"
        self._address = address
        self._name = name
        self._changed = changed
        self._numbers = count(1)
        self._connection: ClientConnection | None = None
        self._out: asyncio.Queue[Operation] = asyncio.Queue()
        self._open: dict[str, asyncio.Future[Any]] = {}
        self._feedback: dict[str, Receive] = {}
        self._topics: dict[str, tuple[Subscribe, Receive]] = {}
        self._joiner = Joiner()

    # --- the connection ---

    async def keep(self) -> None:
        """Connect, and connect again, until this is cancelled."""
        failures = 0
        while True:
            try:
                async with self._connected() as connection:
                    failures = 0
                    await self._talk(connection)
                why = "the other side closed it"
            except asyncio.CancelledError:
                self._lose("it was closed")
                raise
            except Exception as error:
                why = why_lost(error)
            self._lose(why)
            await asyncio.sleep(AGAIN_S[min(failures, len(AGAIN_S) - 1)])
            failures += 1

    def _connected(self) -> connect:
        return _Door(
            self._address.url,
            additional_headers=dict(self._address.headers),
            open_timeout=CONNECTING_S,
            ping_interval=PING_S,
            ping_timeout=None,
            close_timeout=0.2,
            max_size=MOST_BYTES,
            compression=None,
            proxy=None,
            create_connection=_Connection,
        )

    async def _talk(self, connection: ClientConnection) -> None:
        """Send and receive until the connection ends."""
        self._connection, self._out, self._joiner = connection, asyncio.Queue(), Joiner()
        for subscription, _ in self._topics.values():
            self._out.put_nowait(subscription)
        self.loss = ""
        self._changed()
        beside = [
            asyncio.create_task(self._send_all(connection)),
            asyncio.create_task(self._drop_when_silent(connection)),
        ]
        try:
            async for packet in connection:
                self._receive(packet)
        finally:
            for task in beside:
                task.cancel()
            await asyncio.gather(*beside, return_exceptions=True)

    async def _drop_when_silent(self, connection: ClientConnection) -> None:
        assert isinstance(connection, _Connection)
        now = asyncio.get_running_loop().time
        while (left := connection.heard_at + SILENT_S - now()) > 0:
            await asyncio.sleep(left)
        self.drop()

    async def _send_all(self, connection: ClientConnection) -> None:
        while True:
            await connection.send(encode(await self._out.get()))

    def _lose(self, why: str) -> None:
        """End what is open."""
        was_up = not self.loss
        self._connection, self.loss = None, why
        waiting, self._open = self._open, {}
        self._feedback.clear()
        for future in waiting.values():
            if not future.done():
                future.set_exception(LinkError(f"the link to the robot was lost: {why}"))
        if was_up:
            log.debug("the %s connection to %s was lost: %s", self._name, self._address, why)
            self._changed()

    # --- what is sent ---

    def send(self, operation: Operation) -> None:
        """Send this, in its turn.

        Raises:
            LinkError: if there is no connection.
        """
        if self.loss:
            raise LinkError(f"there is no link to the robot: {self.loss}")
        if self._out.qsize() >= MOST_WAITING:
            self.drop()
            raise LinkError("the robot does not read what it is sent")
        self._out.put_nowait(operation)

    def drop(self) -> None:
        """End the connection, as one that does not work any more; a new one is made."""
        if self._connection is not None:
            self._connection.transport.abort()

    def number(self) -> str:
        """An id that nothing else has."""
        return f"{self._name}:{next(self._numbers)}"

    async def ask(self, operation: Operation, feedback: Receive | None = None) -> Any:
        """Send this, and wait for the answer with its id.

        Raises:
            LinkError: if the connection is lost meanwhile.
        """
        answer: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        self._open[operation.id] = answer
        if feedback is not None:
            self._feedback[operation.id] = feedback
        try:
            self.send(operation)
            return await answer
        finally:
            self._open.pop(operation.id, None)
            self._feedback.pop(operation.id, None)

    def subscribe(self, topic: str, kind: str, receive: Receive) -> Callable[[], None]:
        """Be given the messages of a topic; what is returned ends that."""
        id = self.number()
        packed = Compression.CBOR if kind in PACKED else Compression.NONE
        subscription = Subscribe(topic, kind, compression=packed, id=id)
        self._topics[id] = (subscription, receive)
        with suppress(LinkError):  # it is sent when there is a connection
            self.send(subscription)

        def end() -> None:
            if self._topics.pop(id, None):
                with suppress(LinkError):
                    self.send(Unsubscribe(topic, id))

        return end

    # --- what is received ---

    def _receive(self, packet: str | bytes) -> None:
        """Take in a packet; one that cannot be read has no effect."""
        try:
            self._take(decode(packet))
        except PacketError as error:
            log.info("from %s came %s", self._address, error)

    def _take(self, operation: Operation) -> None:
        match operation:
            case Publish(topic, message):
                for subscription, receive in tuple(self._topics.values()):
                    if subscription.topic == topic:
                        self._give(receive, message)
            case ServiceResponse(id=id) | ActionResult(id=id):
                answer = self._open.get(id)
                if answer is not None and not answer.done():
                    answer.set_result(operation)
            case ActionFeedback(values=values, id=id):
                if id in self._feedback:
                    self._give(self._feedback[id], values)
            case Fragment():
                if (whole := self._joiner.add(operation.part)) is not None:
                    inner = decode(whole)
                    if not isinstance(inner, Fragment):
                        self._take(inner)
            case Status(level, said):
                log.info("%s says: %s: %s", self._address, printable(level), printable(said))
            case _:
                log.info("%s asks for %s, which is not for me", self._address, operation.op)

    def _give(self, receive: Receive, message: dict[str, Any]) -> None:
        """Hand a message on; one that does not fit its type has no effect."""
        try:
            receive(message)
        except Exception as error:
            log.info("from %s came a message that I cannot use: %s", self._address, in_words(error))
