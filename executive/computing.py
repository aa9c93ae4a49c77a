"""What takes the machine long and the robot no time: computed beside the thread that ticks.

The thread that ticks sleeps meanwhile, hears a stop at once, and lets no mission time pass: so the
same seed makes the same mission, however fast the machine is.
"""

import atexit
import queue
import threading
import time
from collections.abc import Callable
from typing import Any, Generic, TypeVar

T = TypeVar("T")

IDLE_S = 1.0
"""After this time without work a thread ends."""
LEAVING_S = 0.3
"""The longest that anything waits for what was given up."""

_here = threading.local()
_under_way: "set[Computation[Any]]" = set()
"""Everything that runs now (a set changes in one step: no lock is needed)."""


class GivenUpError(Exception):
    """Nobody waits for this computation any more."""


class Computation(Generic[T]):
    """One piece of work, what came of it, and whether anybody still wants it."""

    def __init__(self, work: Callable[[], T]) -> None:
        """Not begun yet."""
        self._work = work
        self._results: list[T] = []
        self._error: Exception | None = None
        self._afterwards: list[Callable[[], object]] = []
        self._gone = threading.Event()
        self.given_up = False

    def result(self) -> T:
        """What came of it; raises what the work raised."""
        if self._error is not None:
            raise self._error
        return self._results[0]

    def settle(self) -> None:
        """Do what the work put off; called on the thread that ticks."""
        for call in self._afterwards:
            call()

    def run(self) -> None:
        """Work it out; on a thread of its own."""
        _here.computation = self
        try:
            if not self.given_up:
                self._results.append(self._work())
        except Exception as error:
            self._error = error
        except BaseException as error:
            self._error = RuntimeError(repr(error))
        finally:
            _here.computation = None
            self._gone.set()

    def put_off(self, call: Callable[[], object]) -> None:
        """Have this done once the work is finished."""
        self._afterwards.append(call)

    def leave(self, seconds: float) -> None:
        """Give it up, and wait a little until it has noticed."""
        self.given_up = True
        self._gone.wait(seconds)


class Worker:
    """Computes one thing at a time; what was given up is waited for before the next begins.

    Its thread holds up nobody: a process ends without it, and so does what is idle for a while.
    """

    def __init__(self, name: str) -> None:
        """Compute nothing yet."""
        self._name = name
        self._jobs: queue.SimpleQueue[tuple[Computation[Any], Callable[[], None]]]
        self._jobs = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._awake = False
        self._last: Computation[Any] | None = None

    def start(self, computation: Computation[Any], done: Callable[[], None]) -> None:
        """Begin as soon as all before is done; `done` is called on the other thread at the end."""
        self._last = computation
        with self._lock:
            self._jobs.put((computation, done))
            if not self._awake:
                threading.Thread(target=self._run, name=self._name, daemon=True).start()
                self._awake = True

    def _run(self) -> None:
        while True:
            try:
                computation, done = self._jobs.get(timeout=IDLE_S)
            except queue.Empty:
                with self._lock:
                    if self._jobs.empty():
                        self._awake = False
                        return
                continue
            _under_way.add(computation)
            computation.run()
            _under_way.discard(computation)
            done()

    def close(self) -> None:
        """Give up what is computed, and wait a little for it."""
        if self._last is not None:
            self._last.leave(LEAVING_S)


def still_wanted() -> None:
    """Go on; called now and then by whatever computes for long.

    Raises:
        GivenUpError: if this is part of a computation that was given up.
    """
    computation = getattr(_here, "computation", None)
    if computation is not None and computation.given_up:
        raise GivenUpError("given up")


def afterwards(call: Callable[[], object]) -> None:
    """Do this on the thread that ticks: at once if this is it, else when all is computed."""
    computation = getattr(_here, "computation", None)
    if computation is None:
        call()
    else:
        computation.put_off(call)


@atexit.register
def _leave() -> None:
    """Let go before the interpreter is taken apart under the feet of a running library."""
    latest = time.monotonic() + LEAVING_S
    for computation in tuple(_under_way):
        computation.given_up = True
    for computation in tuple(_under_way):
        computation.leave(max(0.0, latest - time.monotonic()))
