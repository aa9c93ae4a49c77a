"""What takes long is computed beside the thread that ticks: a stop is heard, no time passes."""

import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from itertools import pairwise

import pytest
from patience import PATIENCE_S

from executive import clock as clocks
from executive.clock import SimulatedClock
from executive.computing import Computation, GivenUpError, Worker, afterwards, still_wanted
from executive.events import BodyTold, Inbox, StopRequested
from executive.records import Mishap, Record, Seen
from executive.testing.bench import Notebook, Run, run_mission
from executive.types.goals import Goal, LookAt
from executive.types.outcome import MissionStatus
from executive.types.perception import Detection, Frame
from executive.types.results import Failed, Succeeded
from sim.fake import FakeDetector, FakeWorld


class Stillness:
    """A world in which nothing happens."""

    busy = False

    def advance(self, at_most: float) -> float:
        raise AssertionError("it was to stand still")

    def close(self) -> None: ...


class Stubborn(FakeDetector):
    """Looks at a picture until it is told to go on."""

    def __init__(self, world: FakeWorld) -> None:
        super().__init__(world)
        self.begun, self.go_on = threading.Event(), threading.Event()

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        self.begun.set()
        self.go_on.wait(PATIENCE_S)
        return super().detect(frame)


def test_a_stop_is_heard_while_the_detector_thinks() -> None:
    detectors: list[Stubborn] = []

    def stubborn(world: FakeWorld) -> Stubborn:
        detectors.append(Stubborn(world))
        return detectors[0]

    def stop_then(goal: Goal, inbox: Inbox) -> None:
        if isinstance(goal, LookAt):
            threading.Thread(target=stop_when, args=(detectors[0].begun, inbox)).start()

    run = run_mission("Find the mug", detector=stubborn, during=stop_then)
    assert not detectors[0].go_on.is_set()
    assert run.outcome.status == MissionStatus.STOPPED
    assert not run.inbox.awaits_anything
    detectors[0].go_on.set()


def stop_when(begun: threading.Event, inbox: Inbox) -> None:
    begun.wait(PATIENCE_S)
    inbox.post(StopRequested("the person"))


class Slow(FakeDetector):
    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        time.sleep(0.1)
        return super().detect(frame)


def test_a_slow_detector_makes_the_same_mission() -> None:
    def ticks(run: Run) -> list[tuple[str, str]]:
        return [(tick.cause, tick.tip) for tick in run.ticks]

    slow, fast = (run_mission("Find the mug", detector=kind) for kind in (Slow, FakeDetector))
    assert slow.outcome.mission_time_s == fast.outcome.mission_time_s
    assert ticks(slow) == ticks(fast)
    assert [type(r) for r in slow.notebook.records] == [type(r) for r in fast.notebook.records]


class Broken(FakeDetector):
    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        raise OSError("no \x1b[2Jsuch layer")


def test_a_detector_that_raises_is_told_and_ends_no_mission_with_an_error() -> None:
    run = run_mission("Find the mug", detector=Broken)
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert "my eyes failed: no \\x1b[2Jsuch layer" in run.outcome.reason


class Watched(Notebook):
    """A Recorder that may be used by one thread."""

    def record(self, record: Record) -> None:
        assert threading.current_thread() is threading.main_thread()
        super().record(record)


def test_only_the_thread_that_ticks_records() -> None:
    run = run_mission("Find the mug", mishaps=["miss=1"], notebook=Watched())
    order = [type(r) for r in run.notebook.records if isinstance(r, Mishap | Seen)]
    assert (Mishap, Seen) in pairwise(order)


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def gate() -> Iterator[threading.Event]:
    gate = threading.Event()
    yield gate
    gate.set()


def ending(inbox: Inbox) -> tuple[int, Callable[[Computation[object]], None]]:
    """A request, and the sequel that ends it."""
    request = inbox.open()
    return request, lambda computed: inbox.end(request, Succeeded())


def test_other_events_than_a_stop_come_after_what_is_computed(inbox: Inbox) -> None:
    clock = SimulatedClock(inbox, Stillness())
    first, sequel = ending(inbox)
    inbox.compute(Worker("test"), lambda: time.sleep(0.05), sequel)
    other = inbox.open()
    inbox.end(other, Failed("at once"))
    clock.wait(10.0)
    assert {event.request for event in inbox.take_all()} == {first, other}
    assert clock.now() == 0.0


def test_what_was_computed_for_a_dropped_request_has_no_sequel(
    inbox: Inbox, gate: threading.Event
) -> None:
    request, sequel = ending(inbox)
    inbox.compute(Worker("test"), lambda: gate.wait(PATIENCE_S), sequel, request)
    inbox.drop(request)
    assert not inbox.computes
    assert not inbox.wait(0.05)


def test_what_hangs_lets_time_pass(
    inbox: Inbox, gate: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clocks, "HANGING_S", 0.05)
    clock = SimulatedClock(inbox, Stillness())
    inbox.compute(Worker("test"), lambda: gate.wait(PATIENCE_S), lambda computed: None)
    clock.wait(0.2)
    assert clock.now() >= 0.2


def test_the_next_begins_when_what_was_given_up_has_noticed(inbox: Inbox) -> None:
    worker, log, begun = Worker("test"), list[str](), threading.Event()

    def long() -> None:
        begun.set()
        try:
            while True:
                still_wanted()
                time.sleep(0.001)
        except GivenUpError:
            log.append("noticed")

    given_up = inbox.compute(worker, long, lambda computed: log.append("never"))
    threading.Thread(target=stop_when, args=(begun, inbox)).start()
    inbox.await_computed(PATIENCE_S)
    inbox.take_all()
    inbox.give_up(given_up)
    inbox.compute(worker, lambda: log.append("next"), lambda computed: log.append("sequel"))
    inbox.await_computed(PATIENCE_S)
    assert log == ["noticed", "next", "sequel"]


def test_what_it_raises_is_raised_where_it_is_asked_for(inbox: Inbox) -> None:
    computation = inbox.compute(Worker("test"), lambda: 1 // 0, lambda computed: None)
    inbox.await_computed(PATIENCE_S)
    with pytest.raises(ZeroDivisionError):
        computation.result()


def test_what_is_put_off_is_done_by_the_thread_that_ticks_in_its_order(inbox: Inbox) -> None:
    done: list[object] = []

    def work() -> None:
        afterwards(lambda: done.append(threading.current_thread()))

    inbox.compute(Worker("test"), work, lambda computed: done.append("sequel"))
    inbox.await_computed(PATIENCE_S)
    assert done == [threading.main_thread(), "sequel"]
    afterwards(lambda: done.append("at once"))
    assert done[-1] == "at once"


HANGING = """
import io, threading
from executive.app.session import Session
from executive.config import load_settings
from executive.events import BodyTold, Inbox, StopRequested

begun = threading.Event()
inbox = Inbox()
settings = load_settings(world="fake", user="oracle", llm="none")
session = Session(settings, inbox=inbox, out=io.StringIO(), recorded=False)

def hang(frame):
    inbox.post(StopRequested("the person"))
    threading.Event().wait()

session.parts.perception._detector.detect = hang
print(session.run("Find the mug").status)
session.close()
"""


def test_a_process_ends_though_its_detector_hangs() -> None:
    ended = subprocess.run(
        [sys.executable, "-c", HANGING],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=True,
    )
    assert ended.stdout.strip() == "stopped"


def test_what_the_body_tells_does_not_wait_until_all_is_computed(
    inbox: Inbox, gate: threading.Event
) -> None:
    done: list[str] = []
    inbox.compute(Worker("test"), gate.wait, lambda computed: done.append("sequel"))
    inbox.post(BodyTold("I lost the link."))
    SimulatedClock(inbox, Stillness()).wait(None)
    assert inbox.take_all() == (BodyTold("I lost the link."),)
    assert inbox.computes
    gate.set()
    inbox.await_computed(PATIENCE_S)
    assert done == ["sequel"]
