"""Whatever one client asks for, the others have their turn."""

import asyncio

from executive.ros.outbox import Letter, Outbox
from executive.ros.protocol import Publish
from executive.ros.server import send_from

PARTS = 1000


class Fast:
    """A socket whose reader is faster than anybody writes: sending never waits."""

    def __init__(self) -> None:
        self.sent = 0

    async def send(self, packet: str | bytes) -> None:
        self.sent += 1


def test_a_message_in_many_parts_lets_others_have_their_turn() -> None:
    async def sent_before_a_turn() -> int:
        socket, outbox = Fast(), Outbox()
        outbox.put(Letter(Publish("/picture", {"data": "x" * PARTS}), fragment_size=1))
        sending = asyncio.create_task(send_from(outbox, socket))
        await asyncio.sleep(0)
        before = socket.sent
        sending.cancel()
        return before

    assert asyncio.run(sent_before_a_turn()) == 1
