"""The link over rosbridge: two websockets, one for the work and one for stopping.

On the first, a call may have to wait behind a goal (rosbridge before late 2025 is so); on the
second there is never a goal. Nothing of ROS has to be installed here.
"""

import asyncio
import logging
from collections.abc import Awaitable, Callable
from contextlib import suppress

from executive.guards import in_words
from executive.ros.address import Address
from executive.ros.link import GoalEnd, LinkError, Receive, text_of
from executive.ros.offers import Offers
from executive.ros.peer import Peer
from executive.ros.protocol import (
    ActionResult,
    Advertise,
    CallService,
    CancelActionGoal,
    Message,
    Publish,
    SendActionGoal,
    ServiceResponse,
)
from executive.ros.rosapi import read_offers
from executive.text import one_line

log = logging.getLogger(__name__)


class RosbridgeLink:
    """Implements `Link`; made on the thread of the wire."""

    def __init__(self, address: Address) -> None:
        """Connect, and stay connected."""
        self._address = address
        self._work = Peer(address, "work", self._changed)
        self._stop = Peer(address, "stop", self._changed)
        self._tasks = [asyncio.create_task(peer.keep()) for peer in (self._work, self._stop)]
        self._greeting: Callable[[], Awaitable[None]] | None = None
        self._greeter: asyncio.Task[None] | None = None
        self._ready = asyncio.Event()
        self._was_up = False
        self._losses = 0
        self._advertised: set[str] = set()

    @property
    def loss(self) -> str:
        """Why there is no link now; both sockets make one."""
        return self._work.loss or self._stop.loss

    @property
    def losses(self) -> int:
        """How often one of both was lost, after there were both."""
        return self._losses

    async def ready(self, within_s: float) -> None:
        """Wait for both sockets, and until the robot is greeted."""
        try:
            async with asyncio.timeout(within_s):
                await self._ready.wait()
        except TimeoutError:
            why = self.loss or "it does not answer"
            raise LinkError(f"there is no link to the robot: {why}") from None

    def greet_with(self, greeting: Callable[[], Awaitable[None]]) -> None:
        """Have this done whenever there is a link again, now too, before anything else."""
        self._greeting = greeting
        self._changed()

    def _changed(self) -> None:
        """A socket was connected or lost."""
        self._ready.clear()
        self._losses += self._was_up and bool(self.loss)
        self._was_up = not self.loss
        if self._greeter is not None:
            self._greeter.cancel()
            self._greeter = None
        if not self.loss:
            self._advertised.clear()
            self._greeter = asyncio.create_task(self._greet())

    async def _greet(self) -> None:
        if self._greeting is not None:
            try:
                await self._greeting()
            except Exception as error:
                log.warning("the robot at %s was not greeted: %s", self._address, in_words(error))
        self._ready.set()

    async def offers(self) -> Offers:
        """By rosapi."""
        return await read_offers(self)

    async def call(
        self, service: str, kind: str, request: Message, *, within_s: float, urgent: bool = False
    ) -> Message:
        """Call a service, on the socket for stopping if it is urgent."""
        peer = self._stop if urgent else self._work
        asked = CallService(service, request, peer.number(), kind)
        try:
            async with asyncio.timeout(within_s):
                answer = await peer.ask(asked)
        except TimeoutError:
            raise LinkError(f"{service} does not answer") from None
        if not isinstance(answer, ServiceResponse) or not answer.result:
            said = one_line(text_of(getattr(answer, "values", "")))[:200]
            raise LinkError(f"{service} failed" + (f": {said}" if said else ""))
        return answer.values if isinstance(answer.values, dict) else {}

    async def pursue(self, action: str, kind: str, goal: Message, feedback: Receive) -> GoalEnd:
        """Have an action pursue a goal, to its end."""
        id = self._work.number()
        try:
            sent = SendActionGoal(action, kind, goal, feedback=True, id=id)
            end = await self._work.ask(sent, feedback)
        except asyncio.CancelledError:
            with suppress(LinkError):
                self._work.send(CancelActionGoal(action, id))
            raise
        if not isinstance(end, ActionResult):
            raise LinkError(f"{action} answered with {end.op}, which is no result")
        values = end.values if isinstance(end.values, dict) else {}
        return GoalEnd(end.status, values, one_line(text_of(end.values))[:200])

    def subscribe(
        self, topic: str, kind: str, receive: Receive, *, urgent: bool = False
    ) -> Callable[[], None]:
        """Be given all messages of a topic, on the socket for stopping if that is urgent."""
        return (self._stop if urgent else self._work).subscribe(topic, kind, receive)

    def publish(self, topic: str, kind: str, message: Message) -> None:
        """Publish a message, if there is a link."""
        with suppress(LinkError):
            if topic not in self._advertised:
                self._work.send(Advertise(topic, kind, self._work.number()))
                self._advertised.add(topic)
            self._work.send(Publish(topic, message))

    async def close(self) -> None:
        """End both sockets."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
