"""The robot's skills as generators, and helpers that all of them use.

A skill is a generator that commands the motors and yields once per control period; the world steps
the physics in between. It ends by returning, or by raising CannotError. Long computations go to a
Thinker: the skill yields until the result is there, and no simulated time passes meanwhile.
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
    """A skill has failed; the message is a clause for the person: "the way is blocked"."""


class Thinker:
    """Runs the long computations of skills on a worker thread, outside the control loop."""

    def __init__(self, inbox: Inbox) -> None:
        """Begin with no computation; `inbox` tells when a result is there."""
        self._inbox = inbox
        self._worker = Worker("robot")
        self._pending: Computation[Any] | None = None

    @property
    def busy(self) -> bool:
        """Whether a skill waits for a result; simulated time must not pass meanwhile."""
        return self._pending is not None

    def compute(self, work: Callable[[], T]) -> Generator[None, None, T]:
        """Run `work` on the worker thread, and return its result.

        `work` must not use the simulated world. Closing the skill abandons the computation.
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
        """Close the worker; waits a little for computations that were given up."""
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
    """Wait, in simulated time."""
    for _ in range(round(seconds / CONTROL_S)):
        yield


def attempt(skill: Skill) -> Generator[None, None, CannotError | None]:
    """Run a skill; return its failure, if any, so that the caller can clean up first."""
    try:
        yield from skill
    except CannotError as failure:
        return failure
    return None
