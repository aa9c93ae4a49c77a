"""The adapter in docs/own-robot.md keeps the robot's contract, with a driver that only waits."""

import io
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from executive.app.session import Session
from executive.clock import RealClock
from executive.config import load_settings
from executive.events import DeadlinePassed, Inbox
from executive.replay import replay
from executive.testing.contracts.robot import Bench, RobotContract
from executive.types import FLOOR, DriveTo, Goal, Halt, LookAt

PAGE = Path(__file__).parents[2] / "docs" / "own-robot.md"
PLACES = {"coffee_table", "desk", "person"}


def examples() -> list[str]:
    """The code on the page."""
    return [part.split("```")[0] for part in PAGE.read_text().split("```python\n")[1:]]


def adapter() -> dict[str, Any]:
    """What the first example of the page defines."""
    names: dict[str, Any] = {"__name__": "own_robot"}
    exec(examples()[0], names)
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
    clock = RealClock(inbox)
    clock.wait(0.03)
    assert 0.03 <= clock.now() < 1.0
    threading.Timer(0.02, inbox.post, [DeadlinePassed(0.0)]).start()
    clock.wait(None)
    assert inbox.has_events


YOURS = """
import numpy as np
from executive.types import FLOOR, DriveTo, Frame, Goal, Halt, Intrinsics, LookAt, Pose

class WaitingDriver:
    holding, at, closed = False, "person", False

    def pursue(self, goal, called_off):
        called_off.wait(0.01)
        return None

    def close(self):
        self.closed = True

driver = WaitingDriver()

def my_driver():
    return driver

class MyCamera:
    number = 0

    def capture(self):
        self.number += 1
        color = np.full((120, 160, 3), 120, np.uint8)
        lens = Intrinsics(width=160, height=120, fx=125.0, fy=125.0, cx=79.5, cy=59.5)
        depth = np.ones((120, 160), np.float32)
        return Frame(self.number, color, depth, lens, Pose((0, 0, 1.3), (1.0, 0.0, 0.0, 0.0)))
"""


def test_the_page_puts_the_adapter_into_a_mission(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "my_robot.py").write_text("\n".join((examples()[0], YOURS, examples()[-1])))
    monkeypatch.syspath_prepend(tmp_path)
    settings = load_settings(world="my_robot:build", user="none", llm="none", runs=tmp_path)
    with Session(settings, out=io.StringIO()) as session:
        outcome = session.run("Find the power_drill")
    assert (outcome.status, outcome.visited) == ("not_done", ("shelf_lobby",))
    assert replay(Path(outcome.run_dir or "")).parting is None
    import my_robot

    assert my_robot.driver.closed
