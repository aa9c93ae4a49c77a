"""The profile `nav2` drives a node of ROS 2 with Nav2's own interfaces: `pytest -m ros2`.

By rclpy; or by whatever stands at the address in the environment variable ROBOT, such as a
rosbridge: tests/helpers/ros2/rosbridge.sh.
"""

import json
import math
import os
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S, until

from executive.__main__ import main
from executive.events import Inbox
from executive.replay import replay
from executive.ros import __main__ as door
from executive.ros import checking, rclpy_link
from executive.ros.__main__ import main as ros
from executive.ros.address import ROS2, Address
from executive.ros.connection import Connection, connect
from executive.ros.link import LinkError
from executive.ros.profile import load_profile
from executive.testing.bench import four_rooms
from executive.testing.contracts.robot import Bench
from executive.types.goals import DriveTo, Halt, LookAt
from executive.types.perception import Frame
from executive.types.results import Failed, Succeeded
from sim.fake import straight_s

pytestmark = [pytest.mark.ros2, pytest.mark.filterwarnings("ignore::DeprecationWarning")]

ROBOT = os.environ.get("ROBOT", ROS2)


@pytest.fixture(scope="module", autouse=True)
def _patient() -> Iterator[None]:
    """A busy machine takes its time to find and to tell."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checking, "HEARING_S", PATIENCE_S)
        patch.setattr(door, "LISTENING_S", 5.0)
        patch.setattr(rclpy_link, "MATCHING_S", 2.0)
        patch.setattr(rclpy_link, "MEETING_S", PATIENCE_S)
        yield


@pytest.fixture(scope="module")
def robot() -> Iterator[Any]:
    pytest.importorskip("rclpy")
    pytest.importorskip("nav2_msgs")
    from ros2.nav2_robot import Nav2Robot

    made = Nav2Robot(four_rooms().robot_start)
    until(lambda: ros(["check", ROBOT, "--profile", "nav2"]) == 0)  # whoever looks has found it
    yield made
    made.close()


@pytest.fixture
def here(robot: Any) -> Iterator[tuple[Connection, Bench]]:
    home, inbox = four_rooms(), Inbox()

    def ways(start: str, place: str) -> float:
        return straight_s(home, start, place)

    def advance(at_most: float) -> float:
        began = time.monotonic()
        inbox.wait(min(at_most, 0.1))
        return time.monotonic() - began

    made = connect(Address(ROBOT), load_profile("nav2"), home, inbox, "nav2", ways)
    picture(made)
    yield made, Bench(made.robot, inbox, advance)
    made.close()


def picture(here: Connection) -> Frame:
    """The first that comes: then it is found, and told where it is now."""
    frames: list[Frame] = []

    def came() -> bool:
        with suppress(LinkError):
            frames.append(here.camera.capture())
        return bool(frames)

    until(came, "a picture")
    return frames[0]


def test_it_drives_in_legs_and_looks_by_turning(here: tuple[Connection, Bench], robot: Any) -> None:
    made, bench = here
    robot.goals.clear()
    assert bench.do(DriveTo("desk")) == Succeeded()
    assert robot.at[:2] == pytest.approx(four_rooms().stand("desk")[:2], abs=0.01)
    assert len(robot.goals) > 1
    picture(made)
    x, y, yaw = robot.at
    assert (
        bench.do(LookAt("desk", point=(x - math.sin(yaw), y + math.cos(yaw), 0.0))) == Succeeded()
    )
    assert robot.at[2] == pytest.approx(yaw + math.pi / 2, abs=0.1)


def test_it_turns_again_if_where_it_was_is_told_late(here: tuple[Connection, Bench]) -> None:
    _, bench = here
    assert bench.do(DriveTo("shelf_lobby")) == Succeeded()
    assert bench.do(LookAt("shelf_lobby")) == Succeeded()


def test_a_picture_is_of_colour_and_depth_where_the_camera_is(
    here: tuple[Connection, Bench], robot: Any
) -> None:
    frame = picture(here[0])
    assert frame.color.shape[:2] == frame.depth.shape == (48, 64)
    assert frame.pose.position == pytest.approx((*robot.at[:2], 1.0), abs=0.05)


def test_a_halt_stops_it(here: tuple[Connection, Bench], robot: Any) -> None:
    _, bench = here
    bench.robot.start(DriveTo("person"))
    until(lambda: robot.speed)
    assert bench.do(Halt()) == Succeeded()
    assert not robot.speed


def test_why_it_does_not_get_there_is_told_in_its_own_words(
    here: tuple[Connection, Bench], robot: Any
) -> None:
    robot.aborts = "the corridor is blocked"
    result = here[1].do(DriveTo("shelf_lobby"))
    robot.aborts = ""
    assert result == Failed("the corridor is blocked")


def test_a_goal_that_is_refused_ends_at_once(here: tuple[Connection, Bench], robot: Any) -> None:
    robot.rejects = True
    result = here[1].do(DriveTo("shelf_lobby"))
    robot.rejects = False
    assert isinstance(result, Failed)


def test_the_profile_fits_and_look_proposes_one_that_does(
    robot: Any, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert ros(["check", ROBOT, "--profile", "nav2"]) == 0
    assert ros(["look", ROBOT]) == 0
    proposed = tmp_path / "proposed.toml"
    proposed.write_text(capsys.readouterr().out.partition("\n")[2])
    assert ros(["check", ROBOT, "--profile", str(proposed)]) == 0, capsys.readouterr().err


def test_a_mission_looks_for_the_thing_and_replays(
    robot: Any, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    told = ("--llm", "none", "--user", "none", "--json")
    assert main(["--robot", ROBOT, "--profile", "nav2", *told, "Find a power_drill"]) == 1
    outcome = json.loads(capsys.readouterr().out)
    assert outcome["visited"]
    assert replay(tmp_path / outcome["run_dir"]).parting is None
