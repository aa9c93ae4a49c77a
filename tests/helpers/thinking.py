"""A language model that takes its time: so many seconds of the instant world for each reply."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from executive.app.parts import Parts
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Failed
from kb.llm.scripted import Scripted
from sim.fake import FakeRobot, FakeWorld


class Slow(Scripted):
    """Says what it was told to say, later."""

    def __init__(self, replies: Iterable[Any], world: FakeWorld, thinking_s: float) -> None:
        """Take as long in this world."""
        super().__init__((), world.inbox)
        self._world = world
        self._thinking_s = thinking_s
        self._left = list(replies)
        self.cancelled = 0

    def cancel(self, request: int) -> None:
        """Think no more."""
        self.cancelled += self._world.forget(request)
        super().cancel(request)

    def _answer(self, request: ChatRequest | RankRequest) -> int:
        self.requests.append(request)
        reply = self._left.pop(0) if self._left else None

        def finish() -> Any:
            if reply is None:
                return Failed("the script has no more replies")
            return self._result(request, reply)

        return self._world.schedule(self._thinking_s, finish)


def slow(
    replies: Iterable[Any], thinking_s: float, models: list[Slow] | None = None
) -> Callable[[Parts], Parts]:
    """Puts such a model in, and tells which."""

    def change(parts: Parts) -> Parts:
        assert isinstance(parts.robot, FakeRobot)
        model = Slow(replies, parts.robot._world, thinking_s)
        if models is not None:
            models.append(model)
        return replace(parts, model=model)

    return change
