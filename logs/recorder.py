"""The recorder: one queue and one writing thread between the ticking thread and all sinks."""

import contextlib
import logging
import queue
import threading
import time
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import NamedTuple, Protocol

from executive.records import Note, Record
from executive.text import printable
from logs.unwritten import Unwritten

log = logging.getLogger(__name__)

CAPACITY = 1024
"""How many records may wait to be written."""
PATIENCE_S = 0.5
"""How long the ticking thread waits for room in a full queue, before it drops the record."""
POLL_S = 0.005
"""How often it checks for room."""
FLUSH_S = 0.5
"""How long records gather before they are written and flushed together.

Longer is cheaper: to wake the thread for each record would make a mission half as expensive again.
Shorter is safer: with the time that writing takes, a kill loses no more than a second, even on a
busy machine.
"""
LIVE_FLUSH_S = 0.1
"""The same for sinks that someone watches; the others are still flushed every `FLUSH_S`."""
CLOSE_S = 30.0
"""How long `close` waits for the queue to be written and the logs to be finished."""


class Stamp(NamedTuple):
    """When a record was made: mission time (s), and wall time (ns since 1970)."""

    mission_s: float
    wall_ns: int


class Sink(Protocol):
    """One log. All methods but the constructor are called in the writing thread; they may raise."""

    def write(self, stamp: Stamp, record: Record) -> None:
        """Write a record. After an OSError the sink is closed; after others, the record is lost."""
        ...

    def flush(self) -> None:
        """Bring what was written to where it survives the death of this process.

        This is called more often for a sink that someone watches: one with a true attribute `live`.
        """
        ...

    def close(self) -> None:
        """Finish the log; nothing is written afterwards."""
        ...


class FanOut:
    """The Recorder: stamps each record with the time and passes it to every sink, in order.

    It outlives missions: `open` begins the logs of a mission, `close` ends them. If a sink cannot
    write a record, only that record is lost in that sink, with a warning for the first of its kind.
    If the disk fails a sink, it is closed and dropped, and the other sinks record that. Records are
    not copied: do not change one after you have passed it on.
    """

    def __init__(self, now: Callable[[], float], *, live: bool = False) -> None:
        """Take the mission time (s) for the stamps from `now`.

        If `live`, someone watches, and all sinks are flushed every `LIVE_FLUSH_S`.
        """
        self._now = now
        self._live = live
        self._writer: _Writer | None = None
        self.is_whole = True
        """Whether the logs of the last mission are complete; known after `close`.

        False if records were dropped, or a sink failed. A record that does not fit a sink does not
        count.
        """

    def open(self, sinks: Sequence[Sink], started: datetime) -> None:
        """Begin the logs of a mission that started at this wall time; close those still open.

        If no thread can be started, the mission has no logs.
        """
        self.close()
        self.is_whole = True
        try:
            self._writer = _Writer(sinks, LIVE_FLUSH_S if self._live else FLUSH_S)
        except RuntimeError as error:  # no thread can be started
            log.warning("the mission goes on without logs: %s", error)
            self.is_whole = False
        self.record(Note("info", f"mission time 0 is {started.isoformat()}"))

    def record(self, record: Record) -> None:
        """Pass a record on; outside a mission, from `open` to `close`, ignore it. Never raises."""
        if self._writer is not None:
            self._writer.put(Stamp(self._now(), time.time_ns()), record)

    def close(self) -> None:
        """Write what is still queued, then finish all logs."""
        if self._writer is not None:
            self._writer.close(Stamp(self._now(), time.time_ns()))
            self.is_whole = self._writer.is_whole
            self._writer = None


class _Writer:
    """The thread that feeds the sinks of one mission: it writes the queue, flushes, and rests."""

    def __init__(self, sinks: Sequence[Sink], rest_s: float) -> None:
        self._sinks = list(sinks)
        self._unwritten = {id(sink): Unwritten(type(sink).__name__) for sink in sinks}
        self._rest_s = LIVE_FLUSH_S if any(map(_is_live, sinks)) else rest_s
        self._flush_s = rest_s
        self._flushed = -rest_s
        """When all sinks were last flushed (monotonic time, s)."""
        self._unflushed = False
        self._queue: queue.SimpleQueue[tuple[Stamp, Record | None]] = queue.SimpleQueue()
        self._hurry = threading.Event()
        """Ends the rest early."""
        self._lost = 0
        self.is_whole = True
        """Whether no record was dropped, and no sink has failed, so far."""
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()

    def put(self, stamp: Stamp, record: Record) -> None:
        """Queue a record; if the sinks cannot keep up, wait once, then drop records.

        It does not wait for a thread that has ended: what another thread passes on while the logs
        are being closed is dropped.
        """
        if not self._has_room(0.0 if self._lost else PATIENCE_S):
            self._lost += 1
            self.is_whole = False
            return
        if self._lost:
            text = f"{self._lost} records were lost here: the logs could not keep up"
            log.warning(text)
            self._queue.put((stamp, Note("warning", text)))
            self._lost = 0
        self._queue.put((stamp, record))

    def _has_room(self, patience_s: float) -> bool:
        if self._queue.qsize() >= CAPACITY // 2:
            self._hurry.set()
        latest = time.monotonic() + patience_s
        while self._queue.qsize() >= CAPACITY:
            if time.monotonic() >= latest or not self._thread.is_alive():
                return False
            time.sleep(POLL_S)
        return True

    def close(self, stamp: Stamp) -> None:
        self._queue.put((stamp, None))
        self._hurry.set()
        self._thread.join(CLOSE_S)
        if self._thread.is_alive():
            log.warning("the logs were not finished within %g s", CLOSE_S)
            self.is_whole = False

    def _run(self) -> None:
        while True:
            for stamp, record in self._batch():
                if record is None:
                    self._finish(stamp)
                    return
                self._write(stamp, record)
                self._unflushed = True
            self._flush(stamp)
            self._hurry.wait(self._rest_s)
            self._hurry.clear()

    def _batch(self) -> list[tuple[Stamp, Record | None]]:
        """Wait for records; return all in the queue, or none if the sinks must be flushed first."""
        left = max(0.0, self._flushed + self._flush_s - time.monotonic())
        try:
            first = self._queue.get(timeout=left if self._unflushed else None)
        except queue.Empty:
            return []
        return [first, *(self._queue.get() for _ in range(self._queue.qsize()))]

    def _flush(self, stamp: Stamp) -> None:
        """Flush all sinks if it is time, else only those that someone watches."""
        now = time.monotonic()
        if now - self._flushed < self._flush_s and self._rest_s < self._flush_s:
            self._each(stamp, lambda sink: sink.flush() if _is_live(sink) else None)
            return
        self._each(stamp, lambda sink: sink.flush())
        self._flushed, self._unflushed = now, False

    def _write(self, stamp: Stamp, record: Record) -> None:
        self._each(stamp, lambda sink: self._write_to(sink, stamp, record))

    def _write_to(self, sink: Sink, stamp: Stamp, record: Record) -> None:
        try:
            sink.write(stamp, record)
        except OSError:
            raise
        except Exception as error:  # the fault is in this record, not in the log
            if note := self._unwritten[id(sink)].note(type(record).__name__, error):
                self._write(stamp, note)

    def _each(self, stamp: Stamp, do: Callable[[Sink], None]) -> None:
        """Call `do` with every sink; close and drop those that raise, and tell the others."""
        for sink in tuple(self._sinks):
            try:
                do(sink)
            except BaseException as error:  # a panic in Rust code is not an Exception
                if sink in self._sinks:
                    self._sinks.remove(sink)
                    with contextlib.suppress(BaseException):
                        sink.close()
                    self._warn(stamp, sink, "failed and was dropped", error)

    def _finish(self, stamp: Stamp) -> None:
        while self._sinks:
            sink = self._sinks.pop(0)
            try:
                sink.close()
            except BaseException as error:
                self._warn(stamp, sink, "could not be finished", error)

    def _warn(self, stamp: Stamp, sink: Sink, what: str, error: BaseException) -> None:
        text = printable(f"{type(sink).__name__} {what}: {type(error).__name__}: {error}")
        log.warning(text)
        self.is_whole = False
        self._write(stamp, Note("warning", text))


def _is_live(sink: Sink) -> bool:
    """Whether someone watches this sink."""
    return bool(getattr(sink, "live", False))
