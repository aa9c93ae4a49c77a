"""The ROS interface of the served robot: names and types of its topics and actions."""

from dataclasses import replace

from executive.ros.graph import Graph
from executive.ros.moveit import SEMANTICS, SEMANTICS_TYPE

NODE = "/robot_executive_sim"

CLOCK = "/clock"
TF, TF_STATIC = "/tf", "/tf_static"
ODOMETRY = "/odom"
JOINTS = "/joint_states"
TOUCH = "/hand/holding"
COLOR, DEPTH = "/camera/color/image_raw", "/camera/depth/image_raw"
LENS = "/camera/color/camera_info"
PICTURES = (COLOR, DEPTH, LENS)
STATE = (CLOCK, TF_STATIC, TF, ODOMETRY, JOINTS, TOUCH)
"""Topics of the robot's state, in the order of publishing; pictures come after them."""

DRIVE = "/navigate_to_pose"
LOOK = "/head_controller/point_head_action"
PICK, PLACE = "/pick", "/place"
ARM, GRIPPER = "/move_action", "/gripper_controller/gripper_cmd"
GROUP, TIP = "arm", "panda_grasptarget"
"""MoveIt's planning group, and the link at the point between the fingers."""
SRDF = f"""<robot name="panda">
  <group name="{GROUP}"><chain base_link="base_link" tip_link="{TIP}"/></group>
</robot>"""

GRAPH = Graph(
    node=NODE,
    distro="simulated",
    published={
        CLOCK: "rosgraph_msgs/msg/Clock",
        TF: "tf2_msgs/msg/TFMessage",
        TF_STATIC: "tf2_msgs/msg/TFMessage",
        ODOMETRY: "nav_msgs/msg/Odometry",
        JOINTS: "sensor_msgs/msg/JointState",
        TOUCH: "std_msgs/msg/Bool",
        COLOR: "sensor_msgs/msg/Image",
        DEPTH: "sensor_msgs/msg/Image",
        LENS: "sensor_msgs/msg/CameraInfo",
    },
    actions={
        DRIVE: "nav2_msgs/action/NavigateToPose",
        LOOK: "control_msgs/action/PointHead",
        PICK: "executive_msgs/action/Pick",
        PLACE: "executive_msgs/action/Place",
    },
)
"""The interface of a robot with actions to pick up and put down."""

_MOVING = {name: kind for name, kind in GRAPH.actions.items() if name not in (PICK, PLACE)}
MOTIONS = replace(
    GRAPH,
    published={**GRAPH.published, SEMANTICS: SEMANTICS_TYPE},
    actions={
        **_MOVING,
        ARM: "moveit_msgs/action/MoveGroup",
        GRIPPER: "control_msgs/action/GripperCommand",
    },
)
"""The interface of the same robot with MoveIt's motions and a gripper: the client plans grasps."""
