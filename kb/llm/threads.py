"""Threads that never keep the program from ending."""

import queue
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


class Daemons(ThreadPoolExecutor):
    """A thread for each task. Python waits at its end for those of its own pools, for these not.

    For what an event loop does elsewhere, such as asking for the address of a host.
    """

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Begin at once."""
        future: Future[T] = Future()
        work = _Work(future, lambda: fn(*args, **kwargs))
        threading.Thread(target=work.run, name="helper", daemon=True).start()
        return future


class Worker:
    """One thread that does one task after the other, in their order."""

    def __init__(self, name: str) -> None:
        """Start the thread."""
        self._todo: queue.SimpleQueue[_Work | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def submit(self, task: Callable[[], T]) -> Future[T]:
        """Do it when all that was submitted before is done."""
        future: Future[T] = Future()
        self._todo.put(_Work(future, task))
        return future

    def end(self, patience_s: float) -> bool:
        """Leave out what has not begun, and wait; False if what has begun is stuck."""
        try:
            while work := self._todo.get_nowait():
                work.future.cancel()
        except queue.Empty:
            pass
        self._todo.put(None)
        self._thread.join(patience_s)
        return not self._thread.is_alive()

    def _run(self) -> None:
        while work := self._todo.get():
            work.run()


class _Work:
    """A task, and where its result goes."""

    def __init__(self, future: Future[Any], task: Callable[[], Any]) -> None:
        self.future, self._task = future, task

    def run(self) -> None:
        """Do it, unless it was called off."""
        if not self.future.set_running_or_notify_cancel():
            return
        try:
            self.future.set_result(self._task())
        except BaseException as error:  # whoever waits is told
            self.future.set_exception(error)
