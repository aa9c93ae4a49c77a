"""The served robot whose arm only moves: what it is asked for is read strictly, and done."""

import copy
import json
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from served import Raw, served

from executive.__main__ import main as executive
from executive.replay import replay
from executive.ros.moveit import DONE, NO_IK, Load, scene, to_joints, to_pose
from executive.ros.packets import PacketError
from executive.testing.bench import four_rooms
from executive.types.geometry import Pose, Vector3
from sim.__main__ import main as sim
from sim.goals import Face, Grip, MoveHand, MoveJoints
from sim.home.validation import with_placement
from sim.served.offered import ARM, GRIPPER, MOTIONS
from sim.served.requests import Reader
from sim.served.simulation import Simulation

KINDS = MOTIONS.actions
TIP, BASE, DOWN = "panda_grasptarget", "base_link", (1.0, 0.0, 0.0, 0.0)
LOAD = Load((0.04, 0.05, 0.06), Pose((0.0, 0.0, 0.02)), TIP, ())
READER = Reader(four_rooms(), Face)


def to_point(point: Vector3, load: Load | None = None) -> dict[str, Any]:
    """The goal of one who wants the hand there, pointing down."""
    request = to_pose("arm", TIP, BASE, Pose(point, DOWN), 0.5)
    added = scene((), Pose(), BASE, load)
    return {"request": request, "planning_options": {"planning_scene_diff": added}}


def gap(metres: object) -> dict[str, Any]:
    return {"command": {"position": metres, "max_effort": 20.0}}


def test_the_hand_is_sent_to_a_pose_in_the_base_with_what_it_holds() -> None:
    goal = READER.move(to_point((0.5, 0.0, 0.9), LOAD))
    assert isinstance(goal, MoveHand)
    assert (goal.pose, goal.speed, goal.straight) == (Pose((0.5, 0.0, 0.9), DOWN), 0.5, False)
    assert [(shape.size, shape.pose) for shape in goal.load] == [(LOAD.size, LOAD.pose)]


def test_a_straight_way_is_asked_for_by_its_planner() -> None:
    request = to_pose("arm", TIP, BASE, Pose((0.5, 0.0, 0.9), DOWN), 0.5, "pilz/LIN")
    goal = READER.move({"request": request})
    assert isinstance(goal, MoveHand)
    assert goal.straight


def test_joints_are_sent_to_positions() -> None:
    goal = READER.move({"request": to_joints("arm", {"lift": 0.1}, 0.3)})
    assert goal == MoveJoints({"lift": 0.1}, 0.3)


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("group_name",), "legs", "another group than arm"),
        (("max_velocity_scaling_factor",), -1.0, "a speed below zero"),
        (("goal_constraints",), [], "not one of goal_constraints"),
        (("goal_constraints", 0, "position_constraints"), [], "not one of position_constraints"),
        (
            ("goal_constraints", 0, "position_constraints", 0, "link_name"),
            "elbow",
            "another link than panda_grasptarget",
        ),
        (
            ("goal_constraints", 0, "orientation_constraints", 0, "header", "frame_id"),
            "map",
            "give it in base_link",
        ),
        (
            ("goal_constraints", 0, "orientation_constraints", 0, "orientation", "w"),
            9.0,
            "no unit quaternion",
        ),
    ],
)
def test_a_motion_that_is_none_is_refused_in_words(
    path: tuple[str | int, ...], value: object, why: str
) -> None:
    goal = copy.deepcopy(to_point((0.5, 0.0, 0.9)))
    inner: Any = goal["request"]
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    with pytest.raises(PacketError, match=why):
        READER.move(goal)


@pytest.mark.parametrize("wrong", [-0.01, 0.2, "wide", None, True])
def test_a_gap_that_the_hand_has_not_is_refused(wrong: object) -> None:
    with pytest.raises(PacketError):
        READER.grip(gap(wrong))


def test_a_gap_is_read() -> None:
    assert READER.grip(gap(0.05)) == Grip(0.05, 20.0)


LEAVES = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5)
ANYTHING = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner, max_size=2) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=4,
)


@given(st.data())
def test_whatever_stands_in_a_goal_it_is_read_or_refused(data: st.DataObject) -> None:
    goal = copy.deepcopy(to_point((0.5, 0.0, 0.9), LOAD))
    inner: Any = goal
    while isinstance(inner, dict | list) and inner:
        keys = list(inner) if isinstance(inner, dict) else list(range(len(inner)))
        key = data.draw(st.sampled_from(keys))
        if data.draw(st.booleans()) or not isinstance(inner[key], dict | list):
            inner[key] = data.draw(ANYTHING)
            break
        inner = inner[key]
    with suppress(PacketError):
        assert isinstance(READER.move(goal), MoveHand | MoveJoints)


def test_the_packaged_profile_is_of_what_is_offered() -> None:
    text = files("executive").joinpath("ros/profiles/served_moveit2.toml").read_text()
    tables = [table for table in tomllib.loads(text).values() if isinstance(table, dict)]
    assert {table["action"]: table["type"] for table in tables if "action" in table} == KINDS


def test_the_instant_world_has_no_arm_to_move(capsys: pytest.CaptureFixture[str]) -> None:
    assert sim(["serve", "--arm", "moveit", "--world", "fake"]) == 2
    assert "the instant world has no arm" in capsys.readouterr().err


@pytest.fixture(scope="module")
def robot() -> Iterator[Simulation]:
    home = with_placement(four_rooms(), {"sugar_box": "coffee_table"})
    with served(world="physics", arm="moveit", home=home) as simulation:
        yield simulation


@pytest.mark.physics
def test_arm_and_fingers_go_where_they_are_sent_and_tell_if_they_cannot(robot: Simulation) -> None:
    with Raw(robot) as client:
        end = client.do(ARM, to_point((0.5, 0.0, 0.9)))
        assert end["values"]["error_code"] == {"val": DONE}
        end = client.do(ARM, to_point((5.0, 0.0, 0.9)))
        assert (end["status"], end["values"]["error_code"]) == (6, {"val": NO_IK})
        opened, closed = (client.do(GRIPPER, gap(metres))["values"] for metres in (0.06, 0.0))
    assert (opened["reached_goal"], opened["position"]) == (True, pytest.approx(0.06, abs=0.002))
    assert (closed["stalled"], closed["reached_goal"]) == (False, True)


@pytest.mark.physics
def test_a_thing_is_brought_by_motions_alone(
    robot: Simulation,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    options = ("--robot", robot.server.address, "--profile", "served_moveit2", "--llm", "none")
    sent = ("--user", "none", "--json", "Bring a sugar_box on the coffee table")
    assert executive([*options, *sent]) == 0
    outcome = json.loads(capsys.readouterr().out)
    assert outcome["status"] == "done"
    assert robot.body.world.resting_place("sugar_box") == "delivery"
    assert replay(tmp_path / outcome["run_dir"]).parting is None
