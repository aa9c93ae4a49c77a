"""Reads the goals of ROS actions into goals of the simulated robot.

An invalid goal raises `PacketError` with the reason, and is refused.
"""

import math
import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from executive.records import Shape
from executive.ros.packets import PacketError, octets
from executive.ros.protocol import Message
from executive.types.geometry import Pose, Quaternion, Vector3
from executive.types.goals import Goal, Pick, PutDown
from executive.types.perception import Box, Detection
from sim.goals import Face, GoTo, Grip, MoveHand, MoveJoints
from sim.home.home import Home
from sim.served.bodies import Body, drive
from sim.served.messages import MAP
from sim.served.offered import GROUP, TIP

FARTHEST_M = 1000.0
"""Greatest absolute value of a coordinate, or any other number."""
MOST_POINTS = 1_000_000
MOST_TEXT = 200
MOST_JOINTS = 100
STRAIGHT = "LIN"
"""`planner_id` of MoveIt's planner for straight lines."""
BASE = "base_link"
WIDEST_M, STRONGEST_N, WIDEST_LOAD_M = 0.08, 70.0, 1.0
"""Limits of the fingers' gap, of their force, and of the size of a load."""
BOX = 1
"""Type of a box in `shape_msgs/msg/SolidPrimitive`."""
_FIELDS = ("x", "y", "z")
_FLOAT32 = 7
"""Datatype in `sensor_msgs/msg/PointField`."""


@dataclass(frozen=True)
class Reader:
    """Converts goals of actions to goals of the robot.

    The methods that read a goal raise PacketError if it is invalid.

    Attributes:
        home: the robot's home.
        look: returns the goal to look at a point of `map`.
    """

    home: Home
    look: Callable[[Vector3], Goal | Face]

    @classmethod
    def of(cls, home: Home, body: Body) -> "Reader":
        """The reader for a robot in its home."""
        return cls(home, body.look)

    def drive(self, goal: Message) -> Goal | GoTo:
        """`nav2_msgs/action/NavigateToPose`."""
        stamped = _table(goal, "pose")
        _in_frame(stamped)
        pose = _table(stamped, "pose")
        x, y, _ = _vector(_table(pose, "position"))
        return drive(self.home, (x, y, _yaw(_table(pose, "orientation"))))

    def point_head(self, goal: Message) -> Goal | Face:
        """`control_msgs/action/PointHead`."""
        target = _table(goal, "target")
        _in_frame(target)
        return self.look(_vector(_table(target, "point")))

    def pick(self, goal: Message) -> Goal:
        """`executive_msgs/action/Pick`: the object's name, and its visible points in `map`."""
        label, cloud = _text(goal, "label"), _table(goal, "points")
        if cloud.get("width", 0):
            _in_frame(cloud)
        points = _points(cloud)
        mask = np.ones((1, 1), np.bool_)
        cut_off = goal.get("cut_off", False) is True
        return Pick(Detection(label, 1.0, Box(0, 0, 1, 1), mask, points, cut_off))

    def place(self, goal: Message) -> Goal:
        """`executive_msgs/action/Place`: the name of a piece of furniture."""
        return PutDown(_text(goal, "place"))

    def move(self, goal: Message) -> MoveHand | MoveJoints:
        """`moveit_msgs/action/MoveGroup`: the tip to a pose in `base_link`, or joint positions.

        Of the goal's additions to the planning scene, only objects attached to the tip are used.
        Other collision objects are ignored: the simulated planner has the map.
        """
        request, load = _table(goal, "request"), _load(goal)
        if request.get("group_name") != GROUP:
            raise PacketError(f"a goal for another group than {GROUP}")
        speed = min(1.0, _number(request, "max_velocity_scaling_factor", 0.1)) or 0.1
        if not speed > 0:
            raise PacketError("a goal with a speed below zero")
        wanted = _first(request, "goal_constraints")
        if wanted.get("joint_constraints"):
            return MoveJoints(_joints(wanted["joint_constraints"]), speed, load)
        at, turned = (
            _first(wanted, "position_constraints"),
            _first(wanted, "orientation_constraints"),
        )
        for one in (at, turned):
            if one.get("link_name") != TIP:
                raise PacketError(f"a goal for another link than {TIP}")
            _in_frame(one, BASE)
        middle = _first(_table(at, "constraint_region"), "primitive_poses")
        position = _vector(_table(middle, "position"))
        pose = Pose(position, _quaternion(_table(turned, "orientation")))
        return MoveHand(pose, speed, request.get("planner_id") == STRAIGHT, load)

    def grip(self, goal: Message) -> Grip:
        """`control_msgs/action/GripperCommand`: `position` is the gap between the fingers (m)."""
        command = _table(goal, "command")
        gap, force = _number(command, "position"), _number(command, "max_effort", 0.0)
        if not 0 <= gap <= WIDEST_M:
            raise PacketError(f"a gap that is not from 0 to {WIDEST_M:g}")
        return Grip(gap, min(max(force, 0.0), STRONGEST_N) or STRONGEST_N)


# --- fields ---


def _first(message: Message, name: str) -> Message:
    """The only element of a list."""
    value = message.get(name)
    if not isinstance(value, list) or len(value) != 1 or not isinstance(value[0], dict):
        raise PacketError(f"a goal that has not one of {name}")
    return value[0]


def _load(goal: Message) -> tuple[Shape, ...]:
    """The box that is attached to the tip, if any, in the tip's frame."""
    state: Any = goal.get("planning_options")
    for name in ("planning_scene_diff", "robot_state"):
        state = state.get(name) if isinstance(state, dict) else None
    held = state.get("attached_collision_objects") if isinstance(state, dict) else None
    if not held:
        return ()
    one = _first(state, "attached_collision_objects")
    if one.get("link_name") != TIP:
        raise PacketError(f"a goal with a load on another link than {TIP}")
    solid = _table(one, "object")
    box, at = _first(solid, "primitives"), _first(solid, "primitive_poses")
    lengths = box.get("dimensions")
    if box.get("type") != BOX or not isinstance(lengths, list) or len(lengths) != 3:
        raise PacketError("a goal with a load that is no box")
    size = _vector(dict(zip("xyz", lengths, strict=True)))
    if not all(0 < length <= WIDEST_LOAD_M for length in size):
        raise PacketError(f"a goal with a load that is not within {WIDEST_LOAD_M:g} m")
    pose = Pose(_vector(_table(at, "position")), _quaternion(_table(at, "orientation")))
    return (Shape("box", size, (0.0, 0.0, 0.0, 1.0), pose),)


def _joints(constraints: object) -> dict[str, float]:
    given = constraints if isinstance(constraints, list) else []
    tables = [one for one in given[:MOST_JOINTS] if isinstance(one, dict)]
    return {_text(one, "joint_name"): _number(one, "position") for one in tables}


def _quaternion(message: Message) -> Quaternion:
    x, y, z, w = (_number(message, name, 0.0) for name in ("x", "y", "z", "w"))
    if abs(math.hypot(x, y, z, w) - 1.0) > 0.01:
        raise PacketError("a goal with an orientation that is no unit quaternion")
    return x, y, z, w


def _table(message: Message, name: str) -> Message:
    value = message.get(name)
    if not isinstance(value, dict):
        raise PacketError(f"a goal without {name}")
    return value


def _text(message: Message, name: str) -> str:
    value = message.get(name)
    if not isinstance(value, str) or not 0 < len(value) <= MOST_TEXT:
        raise PacketError(f"a goal whose {name} is no name")
    return value


def _number(message: Message, name: str, default: float | None = None) -> float:
    value = message.get(name, default)
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise PacketError(f"a goal with {name} that is no number")
    if not abs(value) <= FARTHEST_M:
        raise PacketError(f"a goal with {name} beyond {FARTHEST_M:g}")
    return float(value)


def _vector(message: Message) -> Vector3:
    return _number(message, "x"), _number(message, "y"), _number(message, "z", 0.0)


def _yaw(message: Message) -> float:
    """The yaw of a quaternion (radians)."""
    x, y, z, w = _quaternion(message)
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def _in_frame(stamped: Message, name: str = MAP) -> None:
    """Check that a message is in the frame `name`."""
    frame = _table(stamped, "header").get("frame_id")
    if frame != name:
        raise PacketError(f"a goal in the frame {str(frame)[:MOST_TEXT]}: give it in {name}")


def _points(cloud: Message) -> NDArray[np.float32]:
    """The finite points (n, 3) of a `sensor_msgs/msg/PointCloud2` (metres).

    Its fields x, y and z must be 32-bit floats.
    """
    count = _count(cloud, "width", 0) * _count(cloud, "height", 1)
    if not count:
        return np.empty((0, 3), np.float32)
    step = _count(cloud, "point_step", 0)
    content = octets(cloud.get("data", b""))
    if count > MOST_POINTS or len(content) != count * step:
        raise PacketError(f"points whose {len(content)} bytes are not {count} times {step}")
    order = ">" if cloud.get("is_bigendian") else "<"
    columns = [_offset(cloud, name, step) for name in _FIELDS]
    kind = np.dtype(
        {
            "names": list(_FIELDS),
            "formats": [f"{order}f4"] * 3,
            "offsets": columns,
            "itemsize": step,
        }
    )
    packed = np.frombuffer(content, kind)
    points = np.column_stack([packed[name] for name in _FIELDS]).astype(np.float32)
    finite: NDArray[np.float32] = points[np.isfinite(points).all(axis=1)]
    return finite


def _offset(cloud: Message, name: str, step: int) -> int:
    """The offset of a coordinate in the bytes of a point."""
    fields = cloud.get("fields")
    for field in fields if isinstance(fields, list) else ():
        if isinstance(field, dict) and field.get("name") == name:
            offset: Any = field.get("offset")
            fits = type(offset) is int and 0 <= offset <= step - struct.calcsize("f")
            if fits and field.get("datatype") == _FLOAT32:
                return int(offset)
    raise PacketError(f"points without {name} as a 32-bit float")


def _count(message: Message, name: str, default: int) -> int:
    value: Any = message.get(name, default)
    if type(value) is not int or not 0 <= value <= MOST_POINTS:
        raise PacketError(f"points with a {name} that is no count")
    return value
