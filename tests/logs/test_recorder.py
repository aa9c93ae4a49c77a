"""Records reach every sink, whatever the other sinks do."""

import logging
import threading
import time

import pytest
from patience import until
from sample_mission import STARTED

from executive.records import Note, Record
from logs import recorder
from logs.recorder import FanOut, Stamp


class ListSink:
    """Keeps what it is given."""

    def __init__(self) -> None:
        self.entries: list[tuple[float, Record]] = []
        self.flushes = 0
        self.closed = False

    def write(self, stamp: Stamp, record: Record) -> None:
        self.entries.append((stamp.mission_s, record))

    def flush(self) -> None:
        self.flushes += 1

    def close(self) -> None:
        self.closed = True

    @property
    def texts(self) -> list[str]:
        return [record.text for _, record in self.entries if isinstance(record, Note)]


class BrokenSink(ListSink):
    """Fails from the second record on."""

    def write(self, stamp: Stamp, record: Record) -> None:
        super().write(stamp, record)
        if len(self.entries) > 1:
            raise OSError("disk full")


class HangingSink(ListSink):
    """Takes its time until it is released."""

    def __init__(self) -> None:
        super().__init__()
        self.released = threading.Event()

    def write(self, stamp: Stamp, record: Record) -> None:
        self.released.wait()
        super().write(stamp, record)


def test_every_sink_gets_every_record_in_order_with_the_mission_time() -> None:
    times = iter([0.0, *(number / 10 for number in range(101))])
    sinks = (ListSink(), ListSink())
    fan_out = FanOut(lambda: next(times))
    fan_out.open(sinks, STARTED)
    for number in range(100):
        fan_out.record(Note("info", str(number)))
    fan_out.close()
    expected = [(number / 10, Note("info", str(number))) for number in range(100)]
    assert [sink.entries[1:] for sink in sinks] == [expected, expected]
    assert all(sink.closed for sink in sinks)


def test_a_recording_begins_by_saying_when_the_mission_started() -> None:
    sink = ListSink()
    fan_out = FanOut(lambda: 0.0)
    fan_out.open([sink], STARTED)
    fan_out.close()
    assert sink.texts == ["mission time 0 is 2024-05-13T09:30:00+00:00"]


def test_a_sink_that_raises_is_closed_and_dropped_and_the_others_are_told(
    caplog: pytest.LogCaptureFixture,
) -> None:
    broken, sound = BrokenSink(), ListSink()
    fan_out = FanOut(lambda: 0.0)
    with caplog.at_level(logging.WARNING):
        fan_out.open([broken, sound], STARTED)
        fan_out.record(Note("info", "one"))
        fan_out.record(Note("info", "two"))
        fan_out.close()
    warning = "BrokenSink failed and was dropped: OSError: disk full"
    assert sorted(sound.texts[1:]) == sorted([warning, "one", "two"])
    assert warning in caplog.text
    assert broken.closed
    assert len(broken.entries) == 2
    assert not fan_out.is_whole


def test_a_mission_whose_logs_have_all_of_it_is_whole_also_after_one_that_was_not() -> None:
    fan_out = FanOut(lambda: 0.0)
    for sink, whole in ((BrokenSink(), False), (ListSink(), True)):
        fan_out.open([sink], STARTED)
        fan_out.record(Note("info", "one"))
        fan_out.close()
        assert fan_out.is_whole == whole


def test_what_is_recorded_outside_a_mission_is_ignored() -> None:
    first, second = ListSink(), ListSink()
    fan_out = FanOut(lambda: 0.0)
    fan_out.record(Note("info", "too early"))
    fan_out.open([first], STARTED)
    fan_out.close()
    fan_out.record(Note("info", "too late"))
    fan_out.open([second], STARTED)
    fan_out.close()
    assert len(first.entries) == len(second.entries) == 1


def test_what_was_written_is_flushed_even_if_nothing_more_happens(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(recorder, "FLUSH_S", 0.02)
    sink = ListSink()
    fan_out = FanOut(lambda: 0.0)
    fan_out.open([sink], STARTED)
    until(lambda: sink.flushes, "the flush")
    time.sleep(0.1)
    assert sink.flushes == 1
    fan_out.close()


def test_who_is_watched_is_flushed_soon_and_the_others_as_ever(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(recorder, "LIVE_FLUSH_S", 0.01)
    monkeypatch.setattr(recorder, "FLUSH_S", 1.0)
    watched, other = ListSink(), ListSink()
    vars(watched)["live"] = True
    fan_out = FanOut(lambda: 0.0)
    fan_out.open([watched, other], STARTED)

    def moved() -> bool:
        fan_out.record(Note("info", "moved"))
        return watched.flushes >= other.flushes + 4

    until(moved, "what is watched")
    flushed = other.flushes
    assert other.entries
    until(lambda: other.flushes > flushed, "the flush")  # though nothing more happens
    fan_out.close()


def test_records_that_come_fast_are_written_before_the_rest_is_over(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(recorder, "FLUSH_S", 60.0)
    monkeypatch.setattr(recorder, "CAPACITY", 10)
    sink = ListSink()
    fan_out = FanOut(lambda: 0.0)
    fan_out.open([sink], STARTED)
    for number in range(100):
        fan_out.record(Note("info", str(number)))
    fan_out.close()
    assert sink.texts[1:] == [str(number) for number in range(100)]


def test_a_sink_that_hangs_delays_the_mission_once_and_costs_records_that_are_counted(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(recorder, "CAPACITY", 10)
    monkeypatch.setattr(recorder, "PATIENCE_S", 0.1)
    waited = list[float]()
    has_room = recorder._Writer._has_room

    def noted(writer: recorder._Writer, patience_s: float) -> bool:
        waited.append(patience_s)
        return has_room(writer, patience_s)

    monkeypatch.setattr(recorder._Writer, "_has_room", noted)
    sink = HangingSink()
    fan_out = FanOut(lambda: 0.0)
    fan_out.open([sink], STARTED)
    for number in range(50):
        fan_out.record(Note("info", str(number)))
    assert set(waited[-30:]) == {0.0}
    sink.released.set()
    until(lambda: fan_out._writer and not fan_out._writer._queue.qsize(), "all that waited")
    fan_out.record(Note("info", "and on"))
    fan_out.close()
    assert sink.texts[-1] == "and on"
    assert "records were lost here" in sink.texts[-2]
    assert "could not keep up" in caplog.text


def test_where_no_thread_is_to_be_had_the_mission_goes_on_without_logs(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def no_thread(self: threading.Thread) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Thread, "start", no_thread)
    fan = FanOut(lambda: 0.0)
    fan.open([ListSink()], STARTED)
    fan.record(Note("info", "lost"))
    fan.close()
    assert "without logs: can't start new thread" in caplog.text
