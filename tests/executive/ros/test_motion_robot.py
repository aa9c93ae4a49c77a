"""A robot that has MoveIt 2 and a gripper, but no skills, takes things and puts them down."""

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from linking import link_to
from motion_robot import PROFILE, MotionRobot
from patience import until
from scipy.spatial.transform import Rotation

from executive.app.handling import KnownThings
from executive.events import Inbox
from executive.ros import checking
from executive.ros.__main__ import main as look
from executive.ros.connection import Connection
from executive.ros.moveit import SEMANTICS
from executive.ros.protocol import GoalStatus
from executive.testing.bench import four_rooms
from executive.testing.contracts.robot import Bench, RobotContract
from executive.types.goals import DriveTo, Halt, LookAt, Pick, PutDown
from executive.types.perception import Box, Detection
from executive.types.results import Failed, Succeeded
from sim.objects.objects import load_objects
from sim.objects.solids import sample_surface

THING = "sugar_box"


@dataclass
class Linked:
    there: MotionRobot
    here: Connection
    bench: Bench


@pytest.fixture
def profile_file() -> Path:
    return PROFILE


@pytest.fixture
def linked(profile_file: Path) -> Iterator[Linked]:
    home, inbox = four_rooms(), Inbox()
    with (
        MotionRobot(home.robot_start) as there,
        link_to(there.url, inbox, profile_file, KnownThings(home)) as here,
    ):
        yield Linked(there, here, Bench(here.robot, inbox, there.advance))


class TestMotionRobot(RobotContract):
    @pytest.fixture
    def bench(self, linked: Linked) -> Bench:
        return linked.bench


def seen(at: np.ndarray) -> Detection:
    """The thing, upright, its middle there: what of its surface is seen from the robot."""
    points, normals = sample_surface(load_objects()[THING].shapes)
    points = points - (0.0, 0.0, load_objects()[THING].size[2] / 2)  # they begin at its foot
    facing = points[(normals[:, 1] < -0.5) | (normals[:, 2] > 0.5)]
    mask = np.ones((1, 1), np.bool_)
    return Detection(THING, 1.0, Box(0, 0, 1, 1), mask, (facing + at).astype(np.float32))


def standing_on(linked: Linked, place: str) -> np.ndarray:
    """Put the thing there; where its middle is in the map."""
    x, y, _ = four_rooms().view_targets(place)[0]
    _, front, _ = four_rooms().stand(place)
    linked.there.thing = np.array([x, y - 0.15 * np.sign(y - front), middle_on(place)])
    return linked.there.thing


def middle_on(place: str) -> float:
    """How high its middle is there (metres)."""
    surface = four_rooms().furniture_named(place).surfaces()[0]
    return float(surface.center[2] + load_objects()[THING].size[2] / 2)


def taken(linked: Linked) -> None:
    """Have it take the thing."""
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    assert linked.bench.do(Pick(seen(at))) == Succeeded()


def test_it_takes_what_it_sees_and_feels_that_it_holds_it(linked: Linked) -> None:
    taken(linked)
    assert linked.here.robot.holding is True
    assert linked.there.thing is not None
    assert linked.there.thing[2] > 0.9


def test_it_puts_down_what_it_holds_where_there_is_room(linked: Linked) -> None:
    taken(linked)
    assert linked.bench.do(DriveTo("coffee_table")) == Succeeded()
    assert linked.bench.do(PutDown("coffee_table")) == Succeeded()
    assert linked.here.robot.holding is False
    x, y, _ = four_rooms().view_targets("coffee_table")[0]
    assert linked.there.thing == pytest.approx((x, y, middle_on("coffee_table")), abs=0.1)


def test_it_comes_near_to_what_it_reaches_for(linked: Linked) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    before = np.linalg.norm(at[:2] - linked.there.at[:2])
    assert linked.bench.do(Pick(seen(at))) == Succeeded()
    assert np.linalg.norm(at[:2] - linked.there.at[:2]) < before - 0.1


def test_a_hand_that_is_around_a_thing_moves_straight(linked: Linked) -> None:
    taken(linked)
    before, around, up, folded = (
        motion.get("planner_id", "") for motion in linked.there.motions[-4:]
    )
    assert (before, around, up, folded) == ("", "LIN", "LIN", "")


def test_its_planner_is_told_where_the_furniture_stands(linked: Linked) -> None:
    taken(linked)
    solids = linked.there.motions[-1]["scene"]["world"]["collision_objects"]
    desk = [one for one in solids if one["id"].startswith("desk_")]
    tops = [in_map(linked, solid)[2] + thickness(solid) / 2 for solid in desk]
    assert max(tops) == pytest.approx(four_rooms().furniture_named("desk").size[2], abs=0.01)
    x, y, _ = np.mean([in_map(linked, solid) for solid in desk], axis=0)
    assert (x, y) == pytest.approx(four_rooms().furniture_named("desk").pose[:2], abs=0.3)


def in_map(linked: Linked, solid: dict[str, Any]) -> np.ndarray:
    """Where a solid is that was told in the frame of the base."""
    at = solid["primitive_poses"][0]["position"]
    x, y, yaw = linked.there.at
    return Rotation.from_euler("z", yaw).apply([at["x"], at["y"], at["z"]]) + (x, y, 0.0)


def thickness(solid: dict[str, Any]) -> float:
    return float(solid["primitives"][0]["dimensions"][2])


def test_what_is_carried_is_kept_clear_of_the_furniture(linked: Linked) -> None:
    taken(linked)
    up, folded = (motion["scene"]["robot_state"] for motion in linked.there.motions[-2:])
    assert up["attached_collision_objects"] == []  # it stands on the desk still
    [held] = folded["attached_collision_objects"]
    assert held["link_name"] == "grip"
    assert held["touch_links"] == ["left_finger", "right_finger"]
    size = held["object"]["primitives"][0]["dimensions"]
    assert size == pytest.approx(load_objects()[THING].size)


def test_what_is_not_there_any_more_is_not_held(linked: Linked) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    linked.there.thing = None
    result = linked.bench.do(Pick(seen(at)))
    assert result == Failed("my hand closed without the sugar_box")
    assert linked.here.robot.holding is False


def test_what_is_out_of_reach_is_told(linked: Linked) -> None:
    at = standing_on(linked, "desk") + (0.0, 0.0, 3.0)
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    result = linked.bench.do(Pick(seen(at)))
    assert result == Failed("I cannot reach the sugar_box: I cannot reach there")


def test_a_thing_without_a_model_is_not_grasped(linked: Linked) -> None:
    unknown = Detection(
        "vase", 1.0, Box(0, 0, 1, 1), np.ones((1, 1), np.bool_), np.ones((9, 3), np.float32)
    )
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    assert linked.bench.do(Pick(unknown)) == Failed("I know no way to grasp the vase")


def test_what_was_not_taken_is_not_put_down(linked: Linked) -> None:
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    assert linked.bench.do(PutDown("desk")) == Failed(
        "I do not know how I hold it, it has to be taken out of my hand"
    )


def test_its_head_turns_to_what_it_looks_at(linked: Linked) -> None:
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    x, y, yaw = linked.there.at
    left = (x - np.sin(yaw), y + np.cos(yaw), 0.5)
    assert linked.bench.do(LookAt("desk", point=left)) == Succeeded()
    pan, tilt = linked.there.head
    assert pan == pytest.approx(np.pi / 2, abs=0.2)
    assert tilt > 0.3


def test_nothing_is_put_down_on_what_is_not_seen(linked: Linked) -> None:
    taken(linked)
    linked.there.is_blind = True
    assert linked.bench.do(PutDown("desk")) == Failed("my camera shows nothing of the desk")


class TestViews:
    @pytest.fixture
    def profile_file(self, tmp_path: Path) -> Path:
        file = tmp_path / "views.toml"
        file.write_text(PROFILE.read_text().replace('mount = "neck"', 'mount = "neck"\nviews = 2'))
        return file

    def test_more_views_than_there_are_surfaces_look_there_again(self, linked: Linked) -> None:
        assert linked.bench.do(DriveTo("desk")) == Succeeded()
        for view in range(2):
            assert linked.bench.do(LookAt("desk", view)) == Succeeded()


def test_what_the_fingers_have_closed_on_when_it_is_stopped_can_be_put_down(
    linked: Linked,
) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    linked.there.squeezes_on = True
    linked.here.robot.start(Pick(seen(at)))
    while not linked.there.holds:
        linked.bench.wait(0.02)
    assert linked.bench.do(Halt()) == Succeeded()
    assert linked.bench.do(PutDown("desk")) == Succeeded()


def test_fingers_that_somebody_else_has_called_off_hold_nothing(linked: Linked) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    linked.there.squeezes_on = True
    request = linked.here.robot.start(Pick(seen(at)))
    while not linked.there.holds:
        linked.bench.wait(0.02)
    linked.there.call_off("/acme/gripper", stalled=True)
    assert linked.bench.end_of(request) == Failed("it was called off")


class TestTouch:
    """One that feels what is between its fingers."""

    @pytest.fixture
    def profile_file(self, tmp_path: Path) -> Path:
        file = tmp_path / "touch.toml"
        hand = 'topic = "/acme/fingers"\njoint = "finger"\nbetween = [0.005, 0.035]'
        file.write_text(f"{PROFILE.read_text()}\n[hand]\n{hand}\n")
        return file

    def test_what_fell_on_the_way_is_told_when_it_is_there(self, linked: Linked) -> None:
        taken(linked)
        request = linked.here.robot.start(DriveTo("coffee_table"))
        linked.bench.wait(0.1)
        linked.there.drop()
        fell = Failed("what I held fell on the way to the coffee_table", lost=True)
        assert linked.bench.end_of(request) == fell

    def test_what_it_does_not_feel_it_does_not_hold_whatever_the_gripper_says(
        self, linked: Linked
    ) -> None:
        at = standing_on(linked, "desk")
        assert linked.bench.do(DriveTo("desk")) == Succeeded()
        linked.there.thing = None
        linked.there.ends[FINGERS] = [None, (DONE, {"stalled": True, "reached_goal": False})]
        result = linked.bench.do(Pick(seen(at)))
        assert result == Failed(f"my hand closed without the {THING}")

    def test_what_fell_is_not_put_down(self, linked: Linked) -> None:
        taken(linked)
        linked.there.drop()
        linked.bench.wait(0.1)
        fell = Failed(f"the {THING} fell from my hand", lost=True)
        assert linked.bench.do(PutDown("desk")) == fell


def test_a_halt_in_the_middle_of_a_pick_ends_all_motions(linked: Linked) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    linked.here.robot.start(Pick(seen(at)))
    linked.bench.wait(0.1)
    assert linked.bench.do(Halt()) == Succeeded()
    assert not linked.there.busy
    done = len(linked.there.motions)
    linked.bench.wait(0.3)
    assert len(linked.there.motions) == done


def stopped_with_its_arm_out(linked: Linked) -> Pick:
    """It was about to pick this up from the desk."""
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    pick = Pick(seen(at))
    linked.here.robot.start(pick)
    while not linked.there.motions:
        linked.bench.wait(0.02)
    assert linked.bench.do(Halt()) == Succeeded()
    return pick


def test_it_does_not_drive_with_its_arm_out(linked: Linked) -> None:
    stopped_with_its_arm_out(linked)
    assert linked.bench.do(DriveTo("person")) == Succeeded()
    assert "joint_constraints" in linked.there.motions[-1]["goal_constraints"][0]


def test_it_does_not_come_near_with_its_arm_out(linked: Linked) -> None:
    pick = stopped_with_its_arm_out(linked)
    done = len(linked.there.goals)
    linked.here.robot.start(pick)
    until(lambda: len(linked.there.goals) > done, "its next goal")
    action, goal = linked.there.goals[done]
    assert action == "/move_action"
    assert "joint_constraints" in goal["request"]["goal_constraints"][0]


ARM, FINGERS = "/move_action", "/acme/gripper"
ABORTED, DONE = GoalStatus.ABORTED, GoalStatus.SUCCEEDED


@pytest.mark.parametrize(
    ("status", "said", "why"),
    [
        (ABORTED, {"error_code": {"val": -1}}, "I found no motion to there"),
        (ABORTED, {"error_code": {"val": -4}}, "my arm could not follow its motion"),
        (ABORTED, {"error_code": {"val": -6}}, "it took too long to find a motion"),
        (ABORTED, {"error_code": {"val": -9876}}, "my arm failed (MoveIt's error -9876)"),
        (GoalStatus.CANCELED, {"error_code": {"val": -7}}, "somebody else called it off"),
        (ABORTED, {"error_code": {"val": 1}}, "my arm did not get there"),
        (ABORTED, {"error_code": "none"}, "my arm did not get there"),
        (DONE, {"error_code": {"val": -4}}, "my arm could not follow its motion"),
    ],
)
def test_why_it_does_not_reach_a_thing_is_told(
    linked: Linked, status: GoalStatus, said: dict[str, Any], why: str
) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    linked.there.ends[ARM] = [(status, said)] * 20
    result = linked.bench.do(Pick(seen(at)))
    assert result == Failed(f"I cannot reach the {THING}: {why}")
    assert linked.here.robot.holding is False


def test_a_motion_without_an_end_is_given_up(linked: Linked) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    linked.there.deaf.add(ARM)
    result = linked.bench.do(Pick(seen(at)))
    assert result == Failed(f"my arm does not answer: no sign of {ARM} for 1 s")


def stuck(linked: Linked, motions_before: int) -> np.ndarray:
    """Have it close its fingers around the thing, and not get away with it; where it stood."""
    at = standing_on(linked, "desk").copy()
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    linked.there.ends[ARM] = [*[None] * motions_before, (ABORTED, {"error_code": {"val": -4}})]
    result = linked.bench.do(Pick(seen(at)))
    assert isinstance(result, Failed)
    assert linked.here.robot.holding is True
    return at


@pytest.mark.parametrize("motions_before", [2, 3])
def test_what_could_not_be_carried_is_carried_on_and_not_dropped(
    linked: Linked, motions_before: int
) -> None:
    at = stuck(linked, motions_before)
    commands = len(linked.there.goals)
    assert linked.bench.do(Pick(seen(at))) == Succeeded()
    assert {action for action, _ in linked.there.goals[commands:]} == {ARM}
    assert linked.there.thing is not None
    assert linked.there.thing[2] > at[2] + 0.05


def test_nothing_else_is_taken_with_a_full_hand(linked: Linked) -> None:
    at = stuck(linked, 3)
    other = dataclasses.replace(seen(at), label="mug")
    assert linked.bench.do(Pick(other)) == Failed(f"my hand already holds the {THING}")
    assert linked.there.holds


@pytest.mark.parametrize(
    ("status", "said"),
    [
        (ABORTED, {"position": 0.0, "stalled": True, "reached_goal": False}),
        (ABORTED, {"state": {"position": [0.01]}, "stalled": True}),
        (DONE, {"position": 0.01, "stalled": True, "reached_goal": False}),
        (ABORTED, {"stalled": True}),
        (ABORTED, {}),
    ],
)
def test_fingers_that_do_not_open_have_put_nothing_down(
    linked: Linked, status: GoalStatus, said: dict[str, Any]
) -> None:
    taken(linked)
    linked.there.ends[FINGERS] = [(status, said)]
    result = linked.bench.do(PutDown("desk"))
    assert isinstance(result, Failed)
    assert result.reason.startswith("my hand does not open")
    assert linked.here.robot.holding is not False


@pytest.mark.parametrize("status", [ABORTED, DONE])
def test_fingers_that_stall_where_they_are_open_are_open(
    linked: Linked, status: GoalStatus
) -> None:
    at = standing_on(linked, "desk")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    said = {"position": 0.078, "stalled": True, "reached_goal": False}
    linked.there.ends[FINGERS] = [(status, said)]
    assert linked.bench.do(Pick(seen(at))) == Succeeded()


def test_joints_that_the_robot_does_not_have_are_told(
    linked: Linked, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "joints.toml"
    file.write_text(f'{PROFILE.read_text()}\n[joints]\ntopic = "/acme/fingers"\n')
    assert look(["check", linked.there.url, "--profile", str(file)]) == 2
    said = capsys.readouterr().err
    assert "arm.carry: the robot has no joint elbow; /acme/fingers tells of finger" in said


def test_a_planning_group_that_moveit_does_not_have_is_told(
    linked: Linked, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "group.toml"
    file.write_text(PROFILE.read_text().replace('group = "arm"', 'group = "manipulator"'))
    assert look(["check", linked.there.url, "--profile", str(file)]) == 2
    said = capsys.readouterr().err
    assert (
        f"arm.group: MoveIt has no planning group manipulator; {SEMANTICS} tells of arm, all"
        in said
    )


@pytest.mark.parametrize("srdf", ["", "<robot", 5])
def test_a_robot_that_does_not_tell_its_groups_is_believed_to_have_it(
    linked: Linked, srdf: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checking, "HEARING_S", 0.5)
    linked.there.srdf = srdf
    assert look(["check", linked.there.url, "--profile", str(PROFILE)]) == 0


def test_look_proposes_its_arm_and_gripper(
    linked: Linked, capsys: pytest.CaptureFixture[str]
) -> None:
    assert look(["look", linked.there.url]) == 0
    said = capsys.readouterr().out
    assert '[arm]\naction = "/move_action"' in said
    assert "# opens_m = ...  # say which" in said
