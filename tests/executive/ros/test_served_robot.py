"""The simulated robot over the wire keeps the contracts, and missions are those in process."""

import io
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from served import served

from executive.app.session import Session
from executive.app.wire import ways_of
from executive.config import load_settings
from executive.events import Inbox
from executive.replay import replay
from executive.ros.address import read_address
from executive.ros.connection import Connection, connect
from executive.ros.profile import load_profile
from executive.testing.bench import four_rooms
from executive.testing.contracts.camera import CameraBench, CameraContract
from executive.testing.contracts.robot import Bench, RobotContract
from executive.types.outcome import Outcome
from logs.questions.comparison import compare
from logs.recording.reader import Run
from sim.served.simulation import Simulation

COMMANDS = (
    "Bring a power_drill",
    "Find a power_drill",
    "Take a power_drill",
    "Find an apple",
    "Bring a mug",
    "Take a banana from the desk",
)


@dataclass
class Linked:
    there: Simulation
    here: Connection
    inbox: Inbox
    bench: Bench


def linked(there: Simulation, profile: str) -> Iterator[Linked]:
    inbox = Inbox()
    address = read_address(there.server.address)
    loaded = load_profile(profile)
    ways = ways_of(four_rooms(), loaded)
    here = connect(address, loaded, four_rooms(), inbox, profile, ways)

    def advance(at_most: float) -> float:
        before, began = here.robot.acted_s(), time.monotonic()
        inbox.wait(min(at_most, 0.05))
        acted, real = here.robot.acted_s() - before, time.monotonic() - began
        return acted or real * 0.1  # a busy machine slows all, but not real time

    try:
        yield Linked(there, here, inbox, Bench(here.robot, inbox, advance))
    finally:
        here.close()


class TestInstantRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        with served() as there:
            for one in linked(there, "served_instant"):
                yield one.bench


@pytest.fixture
def physical() -> Iterator[Linked]:
    with served(world="physics") as there:
        yield from linked(there, "served")


@pytest.mark.physics
class TestPhysicalCamera(CameraContract):
    @pytest.fixture
    def camera_bench(self, physical: Linked) -> CameraBench:
        x, y, _ = four_rooms().robot_start
        return CameraBench(physical.here.camera, robot_at=(x, y))


def mission(words: str, runs: Path, **settings: Any) -> Outcome:
    with Session(
        load_settings(llm="none", user="none", runs=runs, **settings), out=io.StringIO()
    ) as session:
        return session.run(words)


def both(words: str, runs: Path, world: str, profile: str) -> Sequence[Path]:
    """The recordings of a mission over the wire, and of one in process."""
    with served(world=world) as there:
        over = mission(words, runs / "wire", robot=there.server.address, profile=profile)
    here = mission(words, runs / "here", world=world)
    return [Path(outcome.run_dir or "") for outcome in (over, here)]


@pytest.mark.parametrize("words", COMMANDS)
def test_a_mission_over_the_wire_is_the_one_in_process(words: str, tmp_path: Path) -> None:
    over, here = both(words, tmp_path, "fake", "served_instant")
    compared = compare(Run(over), Run(here))
    assert compared.parting is None
    assert compared.ends[0] == compared.ends[1]
    times = [[tick.time_s for tick in Run(run).ticks()] for run in (over, here)]
    assert times[0] == pytest.approx(times[1], abs=1e-3)
    assert replay(over).parting is None


@pytest.mark.physics
def test_a_physical_mission_over_the_wire_is_the_one_in_process(tmp_path: Path) -> None:
    over, here = both("Bring a power_drill", tmp_path, "physics", "served")
    assert compare(Run(over), Run(here)).parting is None
    assert replay(over).parting is None
