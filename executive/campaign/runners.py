"""Runners of a campaign's missions: this process, a process pool, or a cluster.

A runner appends each mission to the journal when it ends.
"""

import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.synchronize import Event
from typing import Any, Protocol

from executive.campaign.workers import start_loading
from executive.errors import ExecutiveError
from executive.shell import leave_stopping_to_the_parent

POLL_S = 0.5
"""How often (s) to check on the workers."""


class Unit(Protocol):
    """Missions that one process runs one after the other: a block, or a household."""

    def run(self, before: Sequence[Any]) -> Iterator[Any]:
        """Run the missions that are not in `before`; yield an entry as each ends."""
        ...


class Kept(Protocol):
    """A file of entries, to which several processes append."""

    @property
    def size(self) -> int:
        """Size in bytes."""
        ...

    def entries(self) -> Sequence[Any]:
        """The entries of all missions that have ended."""
        ...

    def append(self, entry: Any) -> None:
        """Append an entry."""
        ...


class Runner(Protocol):
    """Runs missions; on KeyboardInterrupt, it ends when the running missions have ended."""

    def run(self, campaign: Sequence[Any], journal: Any, progress: Callable[[], None]) -> None:
        """Run all missions that are not in the journal; call `progress` regularly."""
        ...


class InProcess:
    """Runs missions in this process, one after the other."""

    def run(self, campaign: Sequence[Unit], journal: Kept, progress: Callable[[], None]) -> None:
        """Run what is left."""
        before = journal.entries()
        for unit in campaign:
            for entry in unit.run(before):
                journal.append(entry)
                progress()


class ProcessPool:
    """Runs missions in worker processes on this machine, each with one block at a time."""

    def __init__(self, workers: int, interrupted: Callable[[], bool]) -> None:
        """Use this many workers; `interrupted` says whether Ctrl-C was pressed.

        The exception is not enough: it is lost if it is raised within a callback.
        """
        self._workers = workers
        self._interrupted = interrupted

    def run(self, campaign: Sequence[Unit], journal: Kept, progress: Callable[[], None]) -> None:
        """Run the remaining missions; if a worker is killed, go on with the rest.

        Raises:
            ExecutiveError: if workers die without any mission ending in between.
        """
        while True:
            written = journal.size
            try:
                return self._run(campaign, journal, progress)
            except BrokenProcessPool:
                if self._interrupted():  # the signal killed a worker that was still starting
                    raise KeyboardInterrupt from None
                if journal.size == written:
                    raise ExecutiveError(
                        "a worker process died, and the next one, too, before any mission ended; "
                        "try --workers 1, which shows why"
                    ) from None

    def _run(self, campaign: Sequence[Unit], journal: Kept, progress: Callable[[], None]) -> None:
        before = journal.entries()
        context = start_loading()
        stop = context.Event()
        pool = ProcessPoolExecutor(
            self._workers, mp_context=context, initializer=start_worker, initargs=(stop,)
        )
        try:
            left = {pool.submit(work, unit, before, journal) for unit in campaign}
            while left:
                if self._interrupted():
                    raise KeyboardInterrupt
                done, left = wait(left, timeout=POLL_S)
                for future in done:
                    future.result()
                progress()
        except BaseException:
            stop.set()
            print("\nends when the missions under way have ended", file=sys.stderr)
            raise
        finally:
            pool.shutdown(cancel_futures=True)


def on_this_machine(workers: int, interrupted: Callable[[], bool]) -> Runner:
    """A runner in this process, or, for several workers, a pool."""
    return InProcess() if workers == 1 else ProcessPool(workers, interrupted)


# --- in a worker process of the pool ---

_stop: Event | None = None


def start_worker(stop: Event) -> None:
    """Ignore Ctrl-C: the parent handles it, and sets `stop`."""
    global _stop
    _stop = stop
    leave_stopping_to_the_parent()


def work(unit: Unit, before: Sequence[Any], journal: Kept) -> None:
    """Run missions until all have ended or `stop` is set."""
    if _stop and _stop.is_set():
        return
    for entry in unit.run(before):
        journal.append(entry)
        if _stop and _stop.is_set():
            return
