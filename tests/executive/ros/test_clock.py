"""Mission time by the robot's own clock: as far as a goal is under way, and as that time passes."""

import logging
import time
from typing import Any

import pytest

from executive.events import Inbox
from executive.ros import clock
from executive.ros.acting import Acting
from executive.ros.profile import load_profile
from executive.ros.senses import Senses


class Wire:
    """A link over which the robot's clock comes."""

    losses = 0

    def __init__(self) -> None:
        self.topics: dict[str, Any] = {}

    def subscribe(self, topic: str, _: str, receive: Any, **__: Any) -> Any:
        self.topics[topic] = receive
        return lambda: None

    def tell(self, *times_s: float) -> None:
        for time_s in times_s:
            whole = int(time_s)
            stamp = {"sec": whole, "nanosec": round((time_s - whole) * 1e9)}
            self.topics["/clock"]({"clock": stamp})


@pytest.fixture
def wire() -> Any:
    return Wire()


@pytest.fixture
def senses(wire: Any) -> Senses:
    return Senses(wire, load_profile("served"))


@pytest.mark.parametrize(
    ("times_s", "passed_s"),
    [
        ((100.0, 102.0, 105.0), 5.0),
        ((100.0, 102.0, 101.9, 103.0), 3.0),
        ((100.0, 102.0, 5.0, 6.0), 3.0),
        ((100.0, 102.0, 1e9, 1e9 + 1.0), 3.0),
        ((1e9, 100.0, 101.0), 1.0),
    ],
)
def test_time_that_the_clock_is_set_by_does_not_pass(
    wire: Any, senses: Senses, times_s: tuple[float, ...], passed_s: float
) -> None:
    wire.tell(*times_s)
    assert senses.elapsed == pytest.approx(passed_s)


def test_that_it_is_set_is_told(
    wire: Any, senses: Senses, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        wire.tell(100.0, 7300.0)
    assert caplog.messages == ["the robot's clock was set by +7200 s, which do not count"]


def test_time_in_which_the_clock_was_silent_counts_once(
    wire: Any, senses: Senses, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clock, "STANDING_S", 0.1)
    wire.tell(0.0)
    mission = clock.RobotClock(Inbox(), senses)
    time.sleep(0.2)
    mission.wait(0.0)
    assert mission.now() > 0.1
    wire.tell(50.0)
    mission.wait(0.0)
    assert mission.now() == pytest.approx(50.0)


def test_the_time_of_a_clock_that_stands_still_is_real_time(
    wire: Any, senses: Senses, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clock, "STANDING_S", 0.1)
    wire.tell(5.0)
    mission = clock.RobotClock(Inbox(), senses)
    for _ in range(4):
        time.sleep(0.05)
        wire.tell(5.0)
    mission.wait(0.0)
    assert mission.now() > 0.1


def test_only_the_time_at_goals_is_measured(wire: Any, senses: Senses) -> None:
    acting = Acting(senses)
    wire.tell(0.0, 1.0)
    acting.run()
    wire.tell(3.0)
    acting.run()
    wire.tell(4.0)
    acting.pause()
    wire.tell(9.0)
    assert acting.seconds == pytest.approx(3.0)
