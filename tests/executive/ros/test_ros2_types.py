"""What messages consist of, and how they are packed, as ROS 2 itself has it: `pytest -m ros2`."""

import pytest

from executive.ros.cdr import to_cdr
from executive.ros.definitions import fields_of
from executive.ros.rclpy_messages import fill, to_table, type_named

pytestmark = [pytest.mark.ros2, pytest.mark.filterwarnings("ignore::DeprecationWarning")]
STAMPED = {"stamp": {"sec": 7, "nanosec": 8}, "frame_id": "map"}
FRAME = {
    "header": STAMPED,
    "child_frame_id": "base_link",
    "transform": {"translation": {"x": 1.0, "y": 2.0, "z": 3.0}},
}
MESSAGES = {
    "std_msgs/msg/Bool": {"data": True},
    "rosgraph_msgs/msg/Clock": {"clock": {"sec": 3, "nanosec": 4}},
    "tf2_msgs/msg/TFMessage": {"transforms": [FRAME, FRAME]},
    "nav_msgs/msg/Odometry": {"header": STAMPED, "child_frame_id": "base_link"},
    "sensor_msgs/msg/JointState": {"header": STAMPED, "name": ["a", "bc"], "position": [0.5, 1.5]},
    "sensor_msgs/msg/Image": {"header": STAMPED, "height": 1, "width": 2, "data": b"\1\2\3\4\5\6"},
    "sensor_msgs/msg/CameraInfo": {"header": STAMPED, "distortion_model": "plumb_bob"},
    "nav2_msgs/action/NavigateToPose_Feedback": {"number_of_recoveries": 2},
}


@pytest.mark.parametrize("kind", MESSAGES)
def test_a_message_is_as_ros_has_it(kind: str) -> None:
    pytest.importorskip("rclpy")
    from rclpy.serialization import deserialize_message

    made = type_named(kind.removesuffix("_Feedback"))
    made = made.Feedback if kind.endswith("_Feedback") else made
    message, fields = fill(made(), MESSAGES[kind]), fields_of(kind)
    assert fields is not None
    assert [field.name for field in fields] == list(message.get_fields_and_field_types())
    assert deserialize_message(to_cdr(to_table(message), kind), made) == message
