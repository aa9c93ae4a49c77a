"""The robot in PyBullet, served: it drives, looks, stops, and tells only what a robot knows."""

from collections.abc import Iterator

import numpy as np
import pytest
from patience import until
from scipy.spatial.transform import Rotation
from served import ZERO, Raw, look_goal, pick_goal, place_goal, pose_goal, served

from executive.testing.bench import four_rooms
from sim.served.simulation import Simulation

pytestmark = pytest.mark.physics
DRIVE, LOOK = "/navigate_to_pose", "/head_controller/point_head_action"
COLOR, DEPTH = "/camera/color/image_raw", "/camera/depth/image_raw"


@pytest.fixture(scope="module")
def robot() -> Iterator[Simulation]:
    with served(world="physics") as simulation:
        yield simulation


def camera(client: Raw) -> tuple[np.ndarray, np.ndarray]:
    """Where the camera is in `map`, and where it looks, by the frames that are published."""
    frames = {}
    for topic in ("/tf", "/tf_static"):
        for one in client.subscribe(topic)["transforms"]:
            frames[one["child_frame_id"]] = (one["header"]["frame_id"], one["transform"])
    name, position, turn = "camera_optical", np.zeros(3), Rotation.identity()
    while name != "map":
        name, transform = frames[name]
        q, t = transform["rotation"], transform["translation"]
        rotation = Rotation.from_quat([q["x"], q["y"], q["z"], q["w"]])
        position = rotation.apply(position) + [t["x"], t["y"], t["z"]]
        turn = rotation * turn
    return position, turn.apply([0.0, 0.0, 1.0])


def test_it_drives_to_a_place_and_looks_at_it(client: Raw) -> None:
    assert client.do(DRIVE, place_goal("coffee_table"))["status"] == 4
    x, y, _ = four_rooms().stand("coffee_table")
    there = client.subscribe("/odom")["pose"]["pose"]["position"]
    assert (there["x"], there["y"]) == pytest.approx((x, y), abs=0.03)
    assert client.do(LOOK, look_goal("coffee_table"))["status"] == 4
    position, ahead = camera(client)
    away = np.subtract(four_rooms().view_targets("coffee_table")[0], position)
    assert np.dot(away / np.linalg.norm(away), ahead) > 0.999


def test_a_picture_is_of_that_moment_in_color_and_depth(client: Raw) -> None:
    color, depth = (client.subscribe(topic, compression="cbor") for topic in (COLOR, DEPTH))
    assert color["header"]["stamp"] == depth["header"]["stamp"] == _time(client)
    metres = np.frombuffer(depth["data"], "<f4")
    assert 0.3 < np.median(metres[np.isfinite(metres)]) < 5.0


@pytest.fixture
def unhurried() -> Iterator[Raw]:
    """So slow that a drive is heard of while it lasts, however busy the machine is."""
    with served(world="physics", speed=3.0) as robot, Raw(robot) as raw:
        yield raw


def test_it_stops_within_half_a_second_of_its_time(unhurried: Raw) -> None:
    client = unhurried
    client.subscribe("/odom")
    id = client.pursue(DRIVE, place_goal("desk"))
    while client.hear_of("publish")["msg"]["twist"]["twist"]["linear"]["x"] < 0.3:
        pass
    told = client.told(f"{DRIVE}/_action/cancel_goal", goal_info=ZERO)
    assert told["goals_canceling"]
    before = _seconds(_time(client))
    assert client.end_of(id)["status"] == 5
    assert _seconds(_time(client)) - before < 0.6
    assert _speed(client.subscribe("/odom", id="again")) < 0.01


def test_what_still_swings_after_a_look_comes_to_rest_when_all_is_cancelled(client: Raw) -> None:
    def swing() -> float:
        return max(map(abs, client.subscribe("/joint_states", id="anew")["velocity"]))

    client.do(DRIVE, place_goal("high_table"))
    client.do(LOOK, look_goal("high_table"))
    assert swing() > 0.02
    assert not client.told(f"{DRIVE}/_action/cancel_goal", goal_info=ZERO)["goals_canceling"]
    until(lambda: swing() < 0.02, "rest")


@pytest.mark.parametrize("pose", [(100.0, 100.0), (3.1, 7.6)])
def test_a_pose_where_nobody_can_be_is_not_driven_to(
    client: Raw, pose: tuple[float, float]
) -> None:
    end = client.do(DRIVE, pose_goal(*pose))
    assert (end["status"], end["values"]["error_msg"]) == (
        6,
        "there is no room to stand at the place",
    )


@pytest.mark.parametrize("label", ["mug", "unicorn"])
def test_points_of_nothing_are_not_picked(client: Raw, label: str) -> None:
    end = client.do("/pick", pick_goal(label, [(900.0, 0.0, 1.0)] * 100))
    assert end["status"] == 6
    assert client.subscribe("/hand/holding") == {"data": False}


def test_no_frame_is_of_a_thing(client: Raw) -> None:
    told = {one["child_frame_id"] for one in client.subscribe("/tf")["transforms"]}
    assert "camera_optical" in told
    assert told.isdisjoint(four_rooms().objects)


def test_joints_are_told_with_their_velocities(client: Raw) -> None:
    joints = client.subscribe("/joint_states")
    assert {"head_pan", "lift", "panda_finger_joint1"} <= set(joints["name"])
    assert len(joints["velocity"]) == len(joints["position"]) == len(joints["name"])


def _time(client: Raw) -> dict[str, int]:
    return dict(client.told("/rosapi/get_time")["time"])


def _seconds(stamp: dict[str, int]) -> float:
    return stamp["sec"] + stamp["nanosec"] / 1e9


def _speed(odometry: dict) -> float:  # type: ignore[type-arg]
    linear = odometry["twist"]["twist"]["linear"]
    return float(np.hypot(linear["x"], linear["y"]))
