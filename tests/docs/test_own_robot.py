"""The adapter of docs/own-robot.md keeps the robot's contract, and the file with it runs."""

import io
import runpy
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S

from executive.app.session import Session
from executive.clock import RealClock
from executive.config import load_settings
from executive.events import DeadlinePassed, Inbox
from executive.replay import replay
from executive.testing.contracts.robot import Bench, RobotContract
from executive.types.goals import Goal, Halt
from executive.types.outcome import MissionStatus, Outcome

DOCS = Path(__file__).parents[2] / "docs"
PAGE, FILE = DOCS / "own-robot.md", DOCS / "examples" / "own_robot.py"
EXAMPLE = runpy.run_path(str(FILE))


def toy() -> Any:
    """The driver of the example that stands in for hardware."""
    return EXAMPLE["ToyDriver"](("coffee_table", "desk"))


def test_the_page_shows_what_the_file_has() -> None:
    adapter, _, _, build, _ = examples()
    assert adapter in FILE.read_text()
    assert build.rstrip() in FILE.read_text()


def examples() -> list[str]:
    """The code on the page."""
    return [part.split("```")[0] for part in PAGE.read_text().split("```python\n")[1:]]


class TestDriverRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Bench:
        inbox = Inbox()

        def advance(at_most: float) -> float:
            began = time.monotonic()
            inbox.wait(min(at_most, 0.1))
            return time.monotonic() - began

        return Bench(EXAMPLE["DriverRobot"](toy(), inbox), inbox, advance)


def test_a_driver_that_raises_fails_in_words():
    class BrokenDriver:
        holding = False

        def pursue(self, goal: Goal, called_off: threading.Event) -> str | None:
            raise OSError("no connection")

    inbox = Inbox()
    robot = EXAMPLE["DriverRobot"](BrokenDriver(), inbox)
    request = robot.start(Halt())
    inbox.wait(PATIENCE_S)
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


@pytest.fixture
def beside_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with a copy of the example, in which the command is given."""
    copy = tmp_path / "own_robot.py"
    copy.write_text(FILE.read_text())
    monkeypatch.syspath_prepend(tmp_path)
    yield copy
    sys.modules.pop("own_robot", None)


def run(words: str, folder: Path) -> Outcome:
    settings = load_settings(
        world="own_robot:build", search="paper", user="none", llm="none", runs=folder
    )
    with Session(settings, out=io.StringIO()) as session:
        return session.run(words)


def test_the_example_brings_a_thing_and_replays(beside_the_file: Path) -> None:
    outcome = run("Bring the hammer", beside_the_file.parent / "runs")
    assert (outcome.status, outcome.visited) == (MissionStatus.DONE, ("shelf_lobby",))
    assert replay(Path(outcome.run_dir or "")).parting is None


CAMERA = """

import numpy as np
from executive import CameraPerception, Frame, Intrinsics, Pose

class MyCamera:
    number = 0

    def capture(self):
        self.number += 1
        color = np.full((120, 160, 3), 120, np.uint8)
        lens = Intrinsics(width=160, height=120, fx=125.0, fy=125.0, cx=79.5, cy=59.5)
        depth = np.ones((120, 160), np.float32)
        return Frame(self.number, color, depth, lens, Pose((0, 0, 1.3), (1.0, 0.0, 0.0, 0.0)))

closed = []
ToyDriver.close = lambda self: closed.append(self)
"""


def test_a_camera_is_put_in_as_the_page_says(beside_the_file: Path) -> None:
    toys, cameras = "perception = ToyEyes(driver, inbox)\n", examples()[-1]
    text = beside_the_file.read_text().replace("in_map=False, ", "")
    assert toys in text
    beside_the_file.write_text(text.replace(toys, cameras) + CAMERA)
    outcome = run("Find the hammer", beside_the_file.parent / "runs")
    assert (outcome.status, outcome.visited) == (MissionStatus.NOT_DONE, ("shelf_lobby",))
    assert replay(Path(outcome.run_dir or "")).parting is None
    assert len(sys.modules["own_robot"].closed) == 1
