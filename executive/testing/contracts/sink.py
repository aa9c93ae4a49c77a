"""The contract of every Sink. An adapter's tests subclass `SinkContract`.

Provide a fixture `sink_bench` that yields a `SinkBench` with a fresh log.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from typing import Any, cast

from executive.records import Note, Record
from executive.testing.bench import run_mission
from logs.recorder import Sink, Stamp


@dataclass
class SinkBench:
    """A log under test.

    Attributes:
        make: opens it.
        kept: how much can be read from it now, in any unit that grows.
    """

    make: Callable[[], Sink]
    kept: Callable[[], int]


@cache
def a_mission() -> tuple[Record, ...]:
    """All records of a mission in the instant world."""
    return tuple(run_mission("Bring a sugar_box").notebook.records)


def write(sink: Sink, records: Sequence[Record]) -> None:
    """Write the records with timestamps 0.1 s apart."""
    for number, record in enumerate(records):
        sink.write(Stamp(number / 10, 1_700_000_000_000_000_000 + number * 100_000_000), record)


def elsewhere(work: Callable[[], object]) -> None:
    """Do this on another thread, as the recorder does everything but opening a sink."""
    with ThreadPoolExecutor(1) as thread:
        thread.submit(work).result()


class SinkContract:
    """Each method tests one requirement of `logs.recorder.Sink`."""

    def test_it_keeps_a_mission_written_in_another_thread(self, sink_bench: SinkBench) -> None:
        sink = sink_bench.make()

        def work() -> None:
            write(sink, a_mission())
            sink.close()

        elsewhere(work)
        assert sink_bench.kept() > 0

    def test_what_was_flushed_survives_without_an_end(self, sink_bench: SinkBench) -> None:
        sink = sink_bench.make()
        write(sink, a_mission())
        sink.flush()
        before_the_end = sink_bench.kept()
        sink.close()
        assert 0 < before_the_end == sink_bench.kept()

    def test_it_may_be_flushed_at_any_time(self, sink_bench: SinkBench) -> None:
        sink = sink_bench.make()
        sink.flush()
        for record in a_mission()[:20]:
            write(sink, [record])
            sink.flush()
        sink.close()
        assert sink_bench.kept() > 0

    def test_a_mission_of_which_nothing_is_recorded_leaves_a_log_that_reads(
        self, sink_bench: SinkBench
    ) -> None:
        sink_bench.make().close()
        assert sink_bench.kept() >= 0

    def test_a_record_that_cannot_be_written_costs_no_other(self, sink_bench: SinkBench) -> None:
        sink = sink_bench.make()
        with suppress(Exception):
            sink.write(Stamp(0.0, 0), Note("info", cast(Any, object())))
        write(sink, a_mission())
        sink.close()
        assert sink_bench.kept() > 0
