"""The adapter in docs/own-robot.md keeps the robot's contract, with a driver that only waits."""

import threading
import time
from pathlib import Path
from typing import Any

import pytest

from executive.events import DeadlinePassed, Inbox
from executive.testing.contracts.robot import Bench, RobotContract
from executive.types import FLOOR, DriveTo, Goal, Halt, LookAt

PAGE = Path(__file__).parents[2] / "docs" / "own-robot.md"
PLACES = {"coffee_table", "desk", "person"}


def adapter() -> dict[str, Any]:
    """What the first example of the page defines."""
    names: dict[str, Any] = {"__name__": "own_robot"}
    exec(PAGE.read_text().split("```python\n")[1].split("```")[0], names)
    return names


class WaitingDriver:
    holding = False
    at = "person"

    def pursue(self, goal: Goal, called_off: threading.Event) -> str | None:
        called_off.wait(0.02)
        match goal:
            case DriveTo(place) if place in PLACES:
                self.at = place
            case LookAt(place, 0) if place in (self.at, FLOOR):
                pass
            case Halt():
                pass
            case _:
                return f"I cannot do that: {goal}"
        return None


class TestDriverRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Bench:
        inbox = Inbox()

        def advance(at_most: float) -> float:
            began = time.monotonic()
            inbox.wait(min(at_most, 0.1))
            return time.monotonic() - began

        return Bench(adapter()["DriverRobot"](WaitingDriver(), inbox), inbox, advance)


def test_a_driver_that_raises_fails_in_words():
    class BrokenDriver(WaitingDriver):
        def pursue(self, goal: Goal, called_off: threading.Event) -> str | None:
            raise OSError("no connection")

    inbox = Inbox()
    robot = adapter()["DriverRobot"](BrokenDriver(), inbox)
    request = robot.start(Halt())
    inbox.wait(5.0)
    (event,) = inbox.take_all()
    assert event.request == request
    assert event.result.reason == "my driver fails: no connection"


def test_the_real_clock_waits_for_the_deadline_or_an_event():
    inbox = Inbox()
    clock = adapter()["RealClock"](inbox)
    clock.wait(0.03)
    assert 0.03 <= clock.now() < 1.0
    threading.Timer(0.02, inbox.post, [DeadlinePassed(0.0)]).start()
    clock.wait(None)
    assert inbox.has_events
