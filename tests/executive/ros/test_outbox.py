"""What waits for a slow reader: of a topic the newest, and nothing passes an end."""

import asyncio

from executive.ros.outbox import Letter, Outbox
from executive.ros.protocol import ActionResult, Operation, Publish

END = ActionResult("/pick", True, 4)


def said(topic: str, number: int) -> Publish:
    return Publish(topic, {"data": number})


def sent(outbox: Outbox, count: int) -> list[Operation]:
    async def take() -> list[Operation]:
        return [(await outbox.take()).operation for _ in range(count)]

    return asyncio.run(take())


def put(outbox: Outbox, *operations: Operation) -> list[Operation]:
    for one in operations:
        outbox.put(Letter(one), one.topic if isinstance(one, Publish) else None)
    return list(operations)


def test_of_a_topic_only_the_newest_waits() -> None:
    outbox = Outbox()
    _, other, newest = put(outbox, said("/odom", 1), said("/tf", 1), said("/odom", 2))
    assert sent(outbox, 2) == [other, newest]


def test_what_was_before_an_end_is_told_before_it_whatever_comes_later() -> None:
    outbox = Outbox()
    all_of_them = put(outbox, said("/holding", 1), END, said("/holding", 2))
    assert sent(outbox, 3) == all_of_them


def test_what_is_not_wanted_any_more_is_not_sent() -> None:
    outbox = Outbox()
    put(outbox, said("/odom", 1), END, said("/odom", 2))
    outbox.forget("/odom")
    put(outbox, END)
    assert sent(outbox, 2) == [END, END]
