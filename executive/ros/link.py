"""What a robot's adapter needs of the way to it, whichever way that is."""

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any, Protocol

from executive.errors import ExecutiveError, UnreachableError
from executive.ros.offers import Offers
from executive.ros.protocol import GoalStatus, Message

Receive = Callable[[Message], None]
"""Is given each message of a topic, or each feedback of a goal; on the thread of the wire."""


class LinkError(ExecutiveError):
    """It did not get through, or nobody answered, and why, as a clause for the person."""


class NoLinkError(LinkError, UnreachableError):
    """The link was lost and did not come back."""


@dataclass(frozen=True, slots=True, eq=False)
class GoalEnd:
    """How a goal ended, and what its action's result says."""

    status: int
    values: Message
    reason: str = ""
    """Why it failed, as a clause, if that was said."""

    @property
    def succeeded(self) -> bool:
        """Whether it was reached."""
        return self.status == GoalStatus.SUCCEEDED


class Link(Protocol):
    """The way to a robot. Everything is called on its thread, and nothing there takes long.

    What was begun ends: well, or with a `LinkError` as soon as the link is lost.
    """

    @property
    def loss(self) -> str:
        """Why there is no link now, as a clause; empty if there is one."""
        ...

    @property
    def losses(self) -> int:
        """How often it was lost so far."""
        ...

    async def ready(self, within_s: float) -> None:
        """Wait for the link, if there is none.

        Raises:
            LinkError: if there is none in this time (s).
        """
        ...

    def greet_with(self, greeting: Callable[[], Awaitable[None]]) -> None:
        """Have this done whenever there is a link again, before anything else."""
        ...

    async def offers(self) -> Offers:
        """What the robot has.

        Raises:
            LinkError: if it does not tell.
        """
        ...

    async def call(
        self, service: str, kind: str, request: Message, *, within_s: float, urgent: bool = False
    ) -> Message:
        """Call a service; an urgent call waits for nothing that is under way.

        Raises:
            LinkError: if it cannot be called, fails, or does not answer in this time (s).
        """
        ...

    async def pursue(self, action: str, kind: str, goal: Message, feedback: Receive) -> GoalEnd:
        """Have an action pursue a goal, to its end; cancelled here, it is cancelled there.

        Raises:
            LinkError: if the link is lost meanwhile.
        """
        ...

    def subscribe(
        self, topic: str, kind: str, receive: Receive, *, urgent: bool = False
    ) -> Callable[[], None]:
        """Be given all messages of a topic, also after a loss; what is returned ends that.

        What is urgent does not come behind pictures.
        """
        ...

    def publish(self, topic: str, kind: str, message: Message) -> None:
        """Publish a message, if there is a link."""
        ...

    async def close(self) -> None:
        """End it."""
        ...


def text_of(values: Any) -> str:
    """What the answer to a failed call says, if it is text."""
    return values if isinstance(values, str) else ""
