"""Daemon threads, which never keep the program from ending."""

import queue
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


class Daemons(ThreadPoolExecutor):
    """An executor with one daemon thread for each task.

    At exit, Python waits for threads of ordinary pools, but not for these. Meant for what an event
    loop runs in an executor, such as a DNS lookup.
    """

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Run the task at once, in a new thread."""
        future: Future[T] = Future()
        work = _Work(future, lambda: fn(*args, **kwargs))
        threading.Thread(target=work.run, name="helper", daemon=True).start()
        return future


class Worker:
    """One daemon thread that runs tasks in order."""

    def __init__(self, name: str) -> None:
        """Start the thread."""
        self._todo: queue.SimpleQueue[_Work | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def submit(self, task: Callable[[], T]) -> Future[T]:
        """Run the task after all that were submitted before."""
        future: Future[T] = Future()
        self._todo.put(_Work(future, task))
        return future

    def end(self, patience_s: float) -> bool:
        """Cancel the tasks not started yet, and wait; False if the running one does not end."""
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
    """A task and the future of its result."""

    def __init__(self, future: Future[Any], task: Callable[[], Any]) -> None:
        self.future, self._task = future, task

    def run(self) -> None:
        """Run the task, unless it was cancelled."""
        if not self.future.set_running_or_notify_cancel():
            return
        try:
            self.future.set_result(self._task())
        except BaseException as error:  # the future passes it on
            self.future.set_exception(error)
