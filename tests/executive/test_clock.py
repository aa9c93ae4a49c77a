"""Mission time: jumps when nothing happens, runs free for the world, is real for a person."""

import threading
import time

import pytest

from executive.clock import SimulatedClock
from executive.errors import ExecutiveError
from executive.events import Inbox, StopRequested
from executive.types.results import Answered, Succeeded


class Hourglass:
    """A world in which one thing ends after some seconds."""

    def __init__(self, inbox: Inbox, seconds: float) -> None:
        self.inbox, self.left = inbox, seconds
        self.request = inbox.open() if seconds else 0

    @property
    def busy(self) -> bool:
        return self.left > 0

    def advance(self, at_most: float) -> float:
        step = min(at_most, self.left, 0.25)
        self.left -= step
        if not self.left:
            self.inbox.end(self.request, Succeeded())
        return step

    def close(self) -> None: ...


def clock_of(seconds: float = 0.0) -> tuple[Inbox, SimulatedClock]:
    inbox = Inbox()
    return inbox, SimulatedClock(inbox, Hourglass(inbox, seconds))


def test_jumps_to_the_deadline_if_nothing_moves() -> None:
    _, clock = clock_of()
    clock.wait(3600.0)
    assert clock.now() == 3600.0


def test_runs_free_until_the_world_ends_something() -> None:
    inbox, clock = clock_of(1.0)
    clock.wait(None)
    assert clock.now() == 1.0
    assert len(inbox.take_all()) == 1


def test_stops_at_the_deadline_while_the_world_moves() -> None:
    _, clock = clock_of(10.0)
    clock.wait(0.6)
    assert clock.now() == pytest.approx(0.6)


def test_is_paced_to_real_time_while_a_person_thinks() -> None:
    inbox, clock = clock_of()
    request = inbox.open(real=True)
    answered: list[float] = []

    def answer() -> None:
        answered.append(time.monotonic())
        inbox.end(request, Answered("desk"))

    began = time.monotonic()
    threading.Timer(0.1, answer).start()
    clock.wait(60.0)
    assert answered[0] - began - 0.05 < clock.now() < time.monotonic() - began + 0.05


def test_the_world_keeps_up_while_a_person_thinks() -> None:
    inbox = Inbox()
    world = Hourglass(inbox, 1000.0)
    clock = SimulatedClock(inbox, world)
    request = inbox.open(real=True)
    threading.Timer(0.1, inbox.end, (request, Answered("desk"))).start()
    clock.wait(None)
    assert 1000.0 - world.left == pytest.approx(clock.now())


def test_waiting_for_nothing_is_an_error_and_no_hang() -> None:
    _, clock = clock_of()
    with pytest.raises(ExecutiveError, match="waits for nothing"):
        clock.wait(None)


def test_an_event_ends_the_wait_at_once() -> None:
    inbox, clock = clock_of(10.0)
    inbox.post(StopRequested("the person"))
    clock.wait(None)
    assert clock.now() == 0.0


def test_the_end_of_a_dropped_request_is_not_delivered() -> None:
    inbox = Inbox()
    request = inbox.open()
    inbox.drop(request)
    inbox.end(request, Succeeded())
    assert not inbox.has_events
    assert inbox.take_all() == ()


def test_the_end_of_a_request_dropped_after_it_was_posted_is_not_delivered() -> None:
    inbox = Inbox()
    request = inbox.open()
    inbox.end(request, Succeeded())
    assert inbox.has_events
    inbox.drop(request)
    assert inbox.take_all() == ()


def test_only_the_first_end_of_a_request_is_delivered() -> None:
    inbox = Inbox()
    request = inbox.open()
    inbox.end(request, Succeeded())
    inbox.end(request, Succeeded())
    assert len(inbox.take_all()) == 1
    assert not inbox.has_events
