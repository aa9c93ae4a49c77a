"""What is proposed for a robot belongs together: there may be several robots, and cameras."""

import tomllib
from typing import Any

from executive.ros.offers import Offers
from executive.ros.proposing import proposal

NAVIGATE, SPIN = "nav2_msgs/action/NavigateToPose", "nav2_msgs/action/Spin"
WAYS, HEAD = "nav2_msgs/action/ComputePathToPose", "control_msgs/action/PointHead"
CAMERA = ("color/image_raw", "depth/image_rect_raw", "aligned_depth_to_color/image_raw")


def topics(robot: str, *cameras: str) -> dict[str, str]:
    """Of a robot in this namespace, whose cameras have depth."""
    images = {
        f"{robot}/{camera}/{name}": "sensor_msgs/msg/Image" for camera in cameras for name in CAMERA
    }
    infos = {
        name.rpartition("/")[0] + "/camera_info": "sensor_msgs/msg/CameraInfo" for name in images
    }
    frames = dict.fromkeys((f"{robot}/tf", f"{robot}/tf_static"), "tf2_msgs/msg/TFMessage")
    odometry = dict.fromkeys((f"{robot}/wheel/odom", f"{robot}/odom"), "nav_msgs/msg/Odometry")
    return {**images, **infos, **frames, **odometry}


def proposed(topics: dict[str, str], actions: dict[str, str], *frames: str) -> dict[str, Any]:
    return tomllib.loads(proposal(Offers(topics, (), actions), frames))


def test_all_that_is_proposed_is_of_one_robot() -> None:
    """The other one has no way to drive that is known."""
    there = {**topics("/one", "eye"), **topics("/two", "eye")}
    actions = {"/one/spin": SPIN, "/two/spin": SPIN, "/two/go": NAVIGATE, "/one/ways": WAYS}
    profile = proposed(there, actions, "one/base_link", "two/base_link", "map")
    assert profile["frames"] == {
        "map": "map",
        "base": "two/base_link",
        "tf": "/two/tf",
        "tf_static": "/two/tf_static",
    }
    assert profile["drive"] == {"action": "/two/go", "type": NAVIGATE}
    assert profile["look"]["action"] == "/two/spin"
    assert profile["camera"] == {
        "color": "/two/eye/color/image_raw",
        "depth": "/two/eye/aligned_depth_to_color/image_raw",
        "info": "/two/eye/color/camera_info",
    }
    assert profile["odometry"]["topic"] == "/two/odom"


def test_colour_and_depth_are_of_one_camera_and_what_else_there_is_is_told() -> None:
    rear = {"/rear/color/image_raw": "sensor_msgs/msg/Image"}
    text = proposal(Offers({**rear, **topics("", "front")}, (), {"/go": NAVIGATE}), ())
    assert 'color = "/front/color/image_raw"  # or /rear/color/image_raw\n' in text
    assert 'depth = "/front/aligned_depth_to_color/image_raw"\n' in text
    assert 'topic = "/odom"  # or /wheel/odom\n' in text


def test_a_robot_that_plans_ways_is_driven_in_legs() -> None:
    drive = proposed({}, {"/go": NAVIGATE, "/ways": WAYS})["drive"]
    assert (drive["path"], drive["leg_m"]) == ("/ways", 2.0)


def test_actions_whose_types_are_not_told_are_known_by_their_names() -> None:
    """Rosapi tells no types of actions; these are what Nav2 serves, and a head's controller."""
    names = ("assisted_teleop", "compute_path_through_poses", "compute_path_to_pose", "spinner")
    names += ("navigate_through_poses", "navigate_to_pose", "head/point_head_action")
    untold = dict.fromkeys((f"/{name}" for name in names), "")
    profile = proposed({}, untold)
    drive = {"action": "/navigate_to_pose", "type": NAVIGATE}
    assert profile["drive"] == drive | {"path": "/compute_path_to_pose", "leg_m": 2.0}
    assert profile["look"] == {"action": "/head/point_head_action", "type": HEAD}
    assert 'action = ""  # not found; there is /a (type not told), /b (' in proposal(
        Offers({}, (), {"/a": "", "/b": ""}), ()
    )


def test_the_optical_frame_is_named_for_a_head_and_only_if_there_is_one() -> None:
    actions = {"/go": NAVIGATE, "/head": HEAD}
    frames = ("color_optical_frame", "depth_optical_frame")
    assert proposed({}, actions, *frames)["frames"]["camera"] == "color_optical_frame"
    assert "camera" not in proposed({}, {"/go": NAVIGATE}, *frames)["frames"]
    assert "camera" not in proposed({}, actions, "a_color_optical", "b_color_optical")["frames"]


def test_the_clock_has_its_own_name() -> None:
    assert proposed({"/sim/clock": "rosgraph_msgs/msg/Clock"}, {})["clock"]["topic"] == "/sim/clock"
