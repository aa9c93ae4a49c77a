"""ROS messages as plain tables, to our values and back; as ROS 2 spells them, and ROS 1."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from executive.geometry import heading
from executive.ros.packets import PacketError
from executive.ros.protocol import Message
from executive.types.geometry import Pose, Quaternion, Vector3

FRAMES_TYPE = "tf2_msgs/msg/TFMessage"
NONE: Message = {"sec": 0, "nanosec": 0}
"""No time: whatever is newest."""
LATEST_S = 2.0**32
"""ROS has no later time."""
UPRIGHT: Quaternion = (0.0, 0.0, 0.0, 1.0)
"""Not turned."""


# --- as they come ---


def stamp_of(message: Message) -> float:
    """When it was made (s, by the robot's clock)."""
    return seconds(message["header"]["stamp"])


def seconds(time: Message) -> float:
    """A time or duration (s).

    Raises:
        PacketError: if it is none: what counts on it would go wrong for ever.
    """
    whole = time["sec"] if "sec" in time else time["secs"]
    part = time["nanosec"] if "nanosec" in time else time.get("nsecs", 0)
    found = float(whole) + float(part) * 1e-9
    if not abs(found) <= LATEST_S:
        raise PacketError("a time that is none")
    return found


def vector(message: Message) -> Vector3:
    """A point or vector; finite.

    Raises:
        PacketError: if it is none.
    """
    x, y, z = (float(message[axis]) for axis in "xyz")
    if not all(map(math.isfinite, (x, y, z))):
        raise PacketError("a point that is nowhere")
    return x, y, z


def quaternion(message: Message) -> Quaternion:
    """A rotation, of length 1.

    Raises:
        PacketError: if it is none.
    """
    x, y, z, w = (float(message[axis]) for axis in "xyzw")
    length = math.sqrt(x * x + y * y + z * z + w * w)
    if not 0.5 < length < 2.0:
        raise PacketError("a rotation that is none")
    if abs(length - 1.0) < 1e-9:
        return x, y, z, w
    return x / length, y / length, z / length, w / length


def pose_of(transform: Message) -> Pose:
    """A `geometry_msgs/Transform`."""
    return Pose(vector(transform["translation"]), quaternion(transform["rotation"]))


# --- as they go ---


def header(frame: str) -> Message:
    """Of something in this frame, at no time in particular."""
    return {"frame_id": frame, "stamp": NONE}


def point_stamped(point: Vector3, frame: str) -> Message:
    """A `geometry_msgs/PointStamped`."""
    return {"header": header(frame), "point": _xyz(point)}


def planar_pose(x: float, y: float, yaw: float, frame: str) -> Message:
    """A `geometry_msgs/PoseStamped` on the floor."""
    turn = heading(yaw)
    return pose_stamped((x, y, 0.0), turn, frame)


def pose_stamped(position: Vector3, turn: Sequence[float], frame: str) -> Message:
    """A `geometry_msgs/PoseStamped`."""
    orientation = dict(zip("xyzw", turn, strict=True))
    pose = {"position": _xyz(position), "orientation": orientation}
    return {"header": header(frame), "pose": pose}


def point_cloud(points: NDArray[np.float32], frame: str) -> Message:
    """A `sensor_msgs/PointCloud2` of x, y and z."""
    number = len(points)
    return {
        "header": header(frame),
        "height": 1,
        "width": number,
        "fields": [
            {"name": name, "offset": 4 * at, "datatype": 7, "count": 1}
            for at, name in enumerate("xyz")
        ],
        "is_bigendian": False,
        "point_step": 12,
        "row_step": 12 * number,
        "data": points.astype("<f4").tobytes(),
        "is_dense": True,
    }


def everything() -> Message:
    """An `action_msgs/srv/CancelGoal` request that means all goals of the action."""
    return {"goal_info": {"goal_id": {"uuid": [0] * 16}, "stamp": NONE}}


def _xyz(point: Sequence[float]) -> dict[str, Any]:
    return dict(zip("xyz", (float(one) for one in point), strict=True))
