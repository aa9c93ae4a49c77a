"""What every skill of the robot is made of.

A skill is a generator that commands the motors and yields once per control period; the world lets
physics pass in between. It ends by returning, or raises CannotError. What takes long it hands to a
Thinker: until that is computed it yields, too, but no time passes.
"""

from collections.abc import Callable, Generator
from typing import Any, TypeVar

from executive.computing import Computation, Worker
from executive.events import Inbox

T = TypeVar("T")
Skill = Generator[None, None, None]

CONTROL_S = 1 / 60
"""Control period (seconds)."""


class CannotError(Exception):
    """The skill gave up; the message is a clause for the person: "the way is blocked"."""


class Thinker:
    """Has computed what a skill wants to know and what takes long, beside the control periods."""

    def __init__(self, inbox: Inbox) -> None:
        """Think of nothing."""
        self._inbox = inbox
        self._worker = Worker("robot")
        self._pending: Computation[Any] | None = None

    @property
    def busy(self) -> bool:
        """Whether a skill waits for an answer; no time shall pass meanwhile."""
        return self._pending is not None

    def compute(self, work: Callable[[], T]) -> Generator[None, None, T]:
        """Return what `work` returns; it must not touch the simulated world.

        A skill that is closed gives it up.
        """
        pending: Computation[T] = self._inbox.compute(self._worker, work, self._done)
        self._pending = pending
        try:
            while self._pending is pending:
                yield
        finally:
            if self._pending is pending:
                self._pending = None
                self._inbox.give_up(pending)
        return pending.result()

    def close(self) -> None:
        """Wait a little for what was given up."""
        self._worker.close()

    def _done(self, _: Computation[Any]) -> None:
        self._pending = None


def wait_until(true: Callable[[], bool], at_most: float) -> Generator[None, None, bool]:
    """Yield until the condition holds or the time (seconds) is up; return whether it held."""
    for _ in range(round(at_most / CONTROL_S)):
        if true():
            return True
        yield
    return true()


def pause(seconds: float) -> Skill:
    """Let some time pass."""
    for _ in range(round(seconds / CONTROL_S)):
        yield


def attempt(skill: Skill) -> Generator[None, None, CannotError | None]:
    """Run a skill; return its failure, if any, so that the robot can tidy up before it reports."""
    try:
        yield from skill
    except CannotError as failure:
        return failure
    return None
