"""Builds the ROS messages that the robot publishes, as dictionaries with the fields' names.

Timestamps are of the robot's clock (nanoseconds); frames and units follow REP-103 and REP-105.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from executive.geometry import heading
from executive.records import Transform
from executive.ros.protocol import Message
from executive.types.geometry import Pose, Quaternion, Vector3
from executive.types.perception import Frame, Intrinsics

MAP, ODOM, BASE, CAMERA = "map", "odom", "base_link", "camera_optical"
Planar = tuple[float, float, float]
"""x, y (metres) and yaw (radians)."""
_NO_COVARIANCE = [0.0] * 36


def time_message(time_ns: int) -> Message:
    """`builtin_interfaces/msg/Time`, or `Duration`."""
    seconds, nanoseconds = divmod(time_ns, 10**9)
    return {"sec": seconds, "nanosec": nanoseconds}


def header(time_ns: int, frame: str) -> Message:
    """`std_msgs/msg/Header`."""
    return {"stamp": time_message(time_ns), "frame_id": frame}


def clock(time_ns: int) -> Message:
    """`rosgraph_msgs/msg/Clock`."""
    return {"clock": time_message(time_ns)}


def touch(holding: bool) -> Message:
    """`std_msgs/msg/Bool`."""
    return {"data": holding}


def text(said: str) -> Message:
    """`std_msgs/msg/String`."""
    return {"data": said}


def planar_pose(pose: Planar) -> Message:
    """`geometry_msgs/msg/Pose`, with z = 0."""
    x, y, yaw = pose
    turn = heading(yaw)
    return {"position": _vector((x, y, 0.0)), "orientation": _quaternion(turn)}


def odometry(time_ns: int, pose: Planar, velocity: Planar) -> Message:
    """`nav_msgs/msg/Odometry`; `velocity` is in the base's frame, as the twist is."""
    ahead, left, turn = velocity
    twist = {"linear": _vector((ahead, left, 0.0)), "angular": _vector((0.0, 0.0, turn))}
    return {
        "header": header(time_ns, ODOM),
        "child_frame_id": BASE,
        "pose": {"pose": planar_pose(pose), "covariance": _NO_COVARIANCE},
        "twist": {"twist": twist, "covariance": _NO_COVARIANCE},
    }


def joint_states(time_ns: int, joints: Mapping[str, tuple[float, float]]) -> Message:
    """`sensor_msgs/msg/JointState`."""
    return {
        "header": header(time_ns, ""),
        "name": list(joints),
        "position": [position for position, _ in joints.values()],
        "velocity": [velocity for _, velocity in joints.values()],
        "effort": [],
    }


def transforms(time_ns: int, moved: Iterable[Transform]) -> Message:
    """`tf2_msgs/msg/TFMessage`; the parent `map` becomes `odom`, which is the same frame here."""
    return {
        "transforms": [
            {
                "header": header(time_ns, ODOM if one.parent == MAP else one.parent),
                "child_frame_id": one.child,
                "transform": _transform(one.pose),
            }
            for one in moved
        ]
    }


def fixed_transforms() -> Message:
    """`tf2_msgs/msg/TFMessage` with `odom` in `map`: the simulated odometry does not drift."""
    return {
        "transforms": [
            {
                "header": header(0, MAP),
                "child_frame_id": ODOM,
                "transform": _transform(Pose()),
            }
        ]
    }


def color_image(time_ns: int, frame: Frame) -> Message:
    """`sensor_msgs/msg/Image`, rgb8."""
    return _image(time_ns, frame.intrinsics, "rgb8", frame.color)


def depth_image(time_ns: int, frame: Frame) -> Message:
    """`sensor_msgs/msg/Image`, 32FC1: metres, infinite for background."""
    return _image(time_ns, frame.intrinsics, "32FC1", frame.depth.astype("<f4", copy=False))


def camera_info(time_ns: int, lens: Intrinsics) -> Message:
    """`sensor_msgs/msg/CameraInfo` of a pinhole camera without distortion."""
    fx, fy, cx, cy = lens.fx, lens.fy, lens.cx, lens.cy
    none = {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}
    return {
        "header": header(time_ns, CAMERA),
        "height": lens.height,
        "width": lens.width,
        "distortion_model": "plumb_bob",
        "d": [0.0] * 5,
        "k": [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        "r": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "p": [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
        "binning_x": 0,
        "binning_y": 0,
        "roi": none,
    }


def _image(time_ns: int, lens: Intrinsics, encoding: str, pixels: NDArray[Any]) -> Message:
    content = np.ascontiguousarray(pixels).view(np.uint8).reshape(-1)
    return {
        "header": header(time_ns, CAMERA),
        "height": lens.height,
        "width": lens.width,
        "encoding": encoding,
        "is_bigendian": 0,
        "step": content.size // lens.height,
        "data": content,
    }


def _transform(pose: Pose) -> Message:
    return {
        "translation": _vector(pose.position),
        "rotation": _quaternion(pose.orientation),
    }


def _vector(values: Vector3) -> Message:
    return dict(zip("xyz", map(float, values), strict=True))


def _quaternion(values: Quaternion) -> Message:
    return dict(zip("xyzw", map(float, values), strict=True))
