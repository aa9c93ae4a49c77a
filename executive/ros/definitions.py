"""What the messages of a served robot consist of, and how rosapi tells it."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

VARIABLE = 0
"""Length of an array that may have any."""
_FIELD = re.compile(r"(?P<kind>[\w/]+)(?:\[(?P<length>\d*)\])? (?P<name>\w+)")
_TEXT = """
builtin_interfaces/msg/Time: int32 sec, uint32 nanosec
builtin_interfaces/msg/Duration: int32 sec, uint32 nanosec
unique_identifier_msgs/msg/UUID: uint8[16] uuid
rosgraph_msgs/msg/Clock: builtin_interfaces/msg/Time clock
std_msgs/msg/Bool: boolean data
std_msgs/msg/String: string data
std_msgs/msg/Header: builtin_interfaces/msg/Time stamp, string frame_id
geometry_msgs/msg/Vector3: float64 x, float64 y, float64 z
geometry_msgs/msg/Point: float64 x, float64 y, float64 z
geometry_msgs/msg/Quaternion: float64 x, float64 y, float64 z, float64 w
geometry_msgs/msg/Pose: geometry_msgs/msg/Point position, geometry_msgs/msg/Quaternion orientation
geometry_msgs/msg/PoseStamped: std_msgs/msg/Header header, geometry_msgs/msg/Pose pose
geometry_msgs/msg/PoseWithCovariance: geometry_msgs/msg/Pose pose, double[36] covariance
geometry_msgs/msg/Twist: geometry_msgs/msg/Vector3 linear, geometry_msgs/msg/Vector3 angular
geometry_msgs/msg/TwistWithCovariance: geometry_msgs/msg/Twist twist, double[36] covariance
geometry_msgs/msg/Transform:
    geometry_msgs/msg/Vector3 translation, geometry_msgs/msg/Quaternion rotation
geometry_msgs/msg/TransformStamped:
    std_msgs/msg/Header header, string child_frame_id, geometry_msgs/msg/Transform transform
tf2_msgs/msg/TFMessage: geometry_msgs/msg/TransformStamped[] transforms
nav_msgs/msg/Odometry:
    std_msgs/msg/Header header, string child_frame_id,
    geometry_msgs/msg/PoseWithCovariance pose, geometry_msgs/msg/TwistWithCovariance twist
sensor_msgs/msg/JointState:
    std_msgs/msg/Header header, string[] name, double[] position, double[] velocity, double[] effort
sensor_msgs/msg/Image:
    std_msgs/msg/Header header, uint32 height, uint32 width, string encoding, uint8 is_bigendian,
    uint32 step, uint8[] data
sensor_msgs/msg/RegionOfInterest:
    uint32 x_offset, uint32 y_offset, uint32 height, uint32 width, boolean do_rectify
sensor_msgs/msg/CameraInfo:
    std_msgs/msg/Header header, uint32 height, uint32 width, string distortion_model, double[] d,
    double[9] k, double[9] r, double[12] p, uint32 binning_x, uint32 binning_y,
    sensor_msgs/msg/RegionOfInterest roi
nav2_msgs/action/NavigateToPose_Feedback:
    geometry_msgs/msg/PoseStamped current_pose, builtin_interfaces/msg/Duration navigation_time,
    builtin_interfaces/msg/Duration estimated_time_remaining, int16 number_of_recoveries,
    float distance_remaining
control_msgs/action/PointHead_Feedback: double pointing_angle_error
executive_msgs/action/Pick_Feedback: builtin_interfaces/msg/Duration elapsed
executive_msgs/action/Place_Feedback: builtin_interfaces/msg/Duration elapsed
moveit_msgs/action/MoveGroup_Feedback: string state
control_msgs/action/GripperCommand_Feedback:
    double position, double effort, boolean stalled, boolean reached_goal
"""


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a message.

    Attributes:
        name: of the field.
        kind: a primitive type as rosapi calls it, or a message's.
        length: of an array; `VARIABLE`: any; None: it is none.
    """

    name: str
    kind: str
    length: int | None

    @property
    def is_message(self) -> bool:
        """Whether it consists of fields itself."""
        return "/" in self.kind


def _read() -> Iterator[tuple[str, tuple[Field, ...]]]:
    for line in re.sub(r"\n +", " ", _TEXT.strip()).splitlines():
        name, _, told = line.partition(": ")
        fields = []
        for one in _FIELD.finditer(told.replace("float64", "double")):
            length = None if one["length"] is None else int(one["length"] or VARIABLE)
            fields.append(Field(one["name"], one["kind"], length))
        yield name, tuple(fields)


_MESSAGES: Mapping[str, tuple[Field, ...]] = dict(_read())


def fields_of(kind: str) -> tuple[Field, ...] | None:
    """The fields of `PACKAGE/msg/NAME`, in order; None if it is not known here."""
    if kind.endswith("_FeedbackMessage"):
        feedback = kind.removesuffix("Message")
        uuid = Field("goal_id", "unique_identifier_msgs/msg/UUID", None)
        return (uuid, Field("feedback", feedback, None)) if feedback in _MESSAGES else None
    if kind.count("/") == 1:
        kind = kind.replace("/", "/msg/")
    return _MESSAGES.get(kind)


def typedefs(kind: str) -> list[dict[str, Any]]:
    """`rosapi_msgs/msg/TypeDef` of a message, and of all that it consists of."""
    told: dict[str, dict[str, Any]] = {}
    left = [kind]
    while left:
        name = left.pop(0)
        fields = fields_of(name)
        if fields is not None and name not in told:
            told[name] = _typedef(name, fields)
            left += [field.kind for field in fields if field.is_message]
    return list(told.values())


def _typedef(kind: str, fields: tuple[Field, ...]) -> dict[str, Any]:
    return {
        "type": _short(kind),
        "fieldnames": [field.name for field in fields],
        "fieldtypes": [_short(field.kind) for field in fields],
        "fieldarraylen": [-1 if field.length is None else field.length for field in fields],
        "examples": [_example(field) for field in fields],
        "constnames": [],
        "constvalues": [],
    }


def _short(kind: str) -> str:
    """As rosapi calls it: without the middle part."""
    return kind.replace("/msg/", "/").replace("/action/", "/")


def _example(field: Field) -> str:
    if field.length is not None:
        return "[]"
    if field.is_message:
        return "{}"
    return {"string": "", "boolean": "False", "double": "0.0", "float": "0.0"}.get(field.kind, "0")
