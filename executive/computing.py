"""Long computations on worker threads, during which mission time stands still.

The ticking thread sleeps meanwhile, wakes at once for a stop, and does not advance mission time. So
the same seed gives the same mission, however fast the machine is.
"""

import atexit
import queue
import threading
import time
from collections.abc import Callable
from typing import Any, Generic, TypeVar

T = TypeVar("T")

IDLE_S = 1.0
"""A worker thread ends after this time without work."""
LEAVING_S = 0.3
"""The longest wait for an abandoned computation to end."""

_here = threading.local()
_under_way: "set[Computation[Any]]" = set()
"""All running computations. Adding to a set and removing are atomic, so it needs no lock."""


class GivenUpError(Exception):
    """Raised inside a computation that was abandoned."""


class Computation(Generic[T]):
    """One piece of work, with its result, and whether it was abandoned."""

    def __init__(self, work: Callable[[], T]) -> None:
        """Prepare to run `work`."""
        self._work = work
        self._results: list[T] = []
        self._error: Exception | None = None
        self._afterwards: list[Callable[[], object]] = []
        self._gone = threading.Event()
        self.given_up = False

    def result(self) -> T:
        """The result; raises what the work raised."""
        if self._error is not None:
            raise self._error
        return self._results[0]

    def settle(self) -> None:
        """Make the calls that the work deferred; called on the ticking thread."""
        for call in self._afterwards:
            call()

    def run(self) -> None:
        """Do the work; called on the worker thread."""
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
        """Defer a call until `settle`."""
        self._afterwards.append(call)

    def leave(self, seconds: float) -> None:
        """Abandon the work, and wait up to `seconds` for it to end."""
        self.given_up = True
        self._gone.wait(seconds)


class Worker:
    """Runs computations one at a time; an abandoned one has to end before the next begins.

    Its thread is a daemon, so that the process can end without it, and ends when it is idle.
    """

    def __init__(self, name: str) -> None:
        """Prepare a worker; its thread starts with the first computation."""
        self._name = name
        self._jobs: queue.SimpleQueue[tuple[Computation[Any], Callable[[], None]]]
        self._jobs = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._awake = False
        self._last: Computation[Any] | None = None

    def start(self, computation: Computation[Any], done: Callable[[], None]) -> None:
        """Queue a computation; at its end, `done` is called on the worker thread."""
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
        """Abandon the last computation, and wait up to `LEAVING_S` for it to end."""
        if self._last is not None:
            self._last.leave(LEAVING_S)


def still_wanted() -> None:
    """Check whether to go on; long computations call this regularly.

    Raises:
        GivenUpError: if the computation on this thread was abandoned.
    """
    computation = getattr(_here, "computation", None)
    if computation is not None and computation.given_up:
        raise GivenUpError("given up")


def afterwards(call: Callable[[], object]) -> None:
    """Make a call on the ticking thread: at once if this is it, else after the computation."""
    computation = getattr(_here, "computation", None)
    if computation is None:
        call()
    else:
        computation.put_off(call)


@atexit.register
def _leave() -> None:
    """Abandon all at exit: native code must not run while the interpreter shuts down."""
    latest = time.monotonic() + LEAVING_S
    for computation in tuple(_under_way):
        computation.given_up = True
    for computation in tuple(_under_way):
        computation.leave(max(0.0, latest - time.monotonic()))
