"""From the ticking thread to every log: one queue, one writing thread, any number of sinks."""

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
"""Records that may wait to be written."""
PATIENCE_S = 0.5
"""How long the ticking thread waits for room in a full queue before a record is given up."""
POLL_S = 0.005
"""How often it looks for room."""
FLUSH_S = 0.5
"""How long records gather before they are written and flushed together. A thread that is woken for
each record costs the mission half as much again; and with the time that writing takes, on a busy
machine too, no more than a second is lost."""
LIVE_FLUSH_S = 0.1
"""The same of sinks that someone watches; the others are flushed as ever."""
CLOSE_S = 30.0
"""How long `close` waits for what is queued to be written."""


class Stamp(NamedTuple):
    """When a record was made: mission time (s), and wall time (ns since 1970)."""

    mission_s: float
    wall_ns: int


class Sink(Protocol):
    """One log. Everything but its making happens in the writing thread; it may raise."""

    def write(self, stamp: Stamp, record: Record) -> None:
        """Keep a record. An OSError is the end of the log, another exception that of the record."""
        ...

    def flush(self) -> None:
        """Bring what was written to where it survives the death of this process.

        Sooner, if someone watches: a sink with a true attribute `live` says so.
        """
        ...

    def close(self) -> None:
        """Finish the log; nothing is written afterwards."""
        ...


class FanOut:
    """The Recorder: stamps each record with the time and passes it to every sink.

    It outlives missions: `open` begins a mission's logs, `close` ends them, and what is recorded in
    between reaches the sinks in order. A record that a sink cannot write costs it that record, and
    is told once a kind; a sink that the disk fails is closed and dropped, and the others are told.
    Records are not copied: whoever hands one over must not change it afterwards.
    """

    def __init__(self, now: Callable[[], float], *, live: bool = False) -> None:
        """Stamp with what `now` returns: the mission time (s); `live` if someone watches."""
        self._now = now
        self._live = live
        self._writer: _Writer | None = None
        self.is_whole = True
        """Whether every log of the last mission has all of it, as far as that has been written."""

    def open(self, sinks: Sequence[Sink], started: datetime) -> None:
        """Begin a mission that started at this wall time; a mission still open is closed first."""
        self.close()
        self.is_whole = True
        try:
            self._writer = _Writer(sinks, LIVE_FLUSH_S if self._live else FLUSH_S)
        except RuntimeError as error:  # no thread is to be had
            log.warning("the mission goes on without logs: %s", error)
            self.is_whole = False
        self.record(Note("info", f"mission time 0 is {started.isoformat()}"))

    def record(self, record: Record) -> None:
        """Pass a record on; without an open mission it is ignored. Never raises."""
        if self._writer is not None:
            self._writer.put(Stamp(self._now(), time.time_ns()), record)

    def close(self) -> None:
        """Write what is still queued, then finish all logs."""
        if self._writer is not None:
            self._writer.close(Stamp(self._now(), time.time_ns()))
            self.is_whole = self._writer.is_whole
            self._writer = None


class _Writer:
    """The thread that feeds one mission's sinks: writes what is there, flushes, and rests."""

    def __init__(self, sinks: Sequence[Sink], rest_s: float) -> None:
        self._sinks = list(sinks)
        self._unwritten = {id(sink): Unwritten(type(sink).__name__) for sink in sinks}
        self._rest_s = LIVE_FLUSH_S if any(map(_is_live, sinks)) else rest_s
        self._flush_s = rest_s
        self._flushed = -rest_s
        """When all sinks were flushed last (s)."""
        self._unflushed = False
        self._queue: queue.SimpleQueue[tuple[Stamp, Record | None]] = queue.SimpleQueue()
        self._hurry = threading.Event()
        """Ends the rest."""
        self._lost = 0
        self.is_whole = True
        """Whether nothing was lost so far."""
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()

    def put(self, stamp: Stamp, record: Record) -> None:
        """Queue a record; if the sinks cannot keep up, wait once, then give up records.

        Nobody waits for a thread that has ended: what another one hands over as the logs are closed
        is given up.
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
        """All that waits to be written; none, if nothing comes before sinks have to be flushed."""
        left = max(0.0, self._flushed + self._flush_s - time.monotonic())
        try:
            first = self._queue.get(timeout=left if self._unflushed else None)
        except queue.Empty:
            return []
        return [first, *(self._queue.get() for _ in range(self._queue.qsize()))]

    def _flush(self, stamp: Stamp) -> None:
        """Flush those that someone watches, and if it is time, all."""
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
        except Exception as error:  # whatever is wrong is wrong with this record
            if note := self._unwritten[id(sink)].note(type(record).__name__, error):
                self._write(stamp, note)

    def _each(self, stamp: Stamp, do: Callable[[Sink], None]) -> None:
        """Do it to every sink; close and drop those that raise, and tell the others."""
        for sink in tuple(self._sinks):
            try:
                do(sink)
            except BaseException as error:  # a panic in a sink's Rust code is no Exception
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
    """Whether someone watches what it is told."""
    return bool(getattr(sink, "live", False))
