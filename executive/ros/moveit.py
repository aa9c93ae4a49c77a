"""Goals of MoveIt 2's `MoveGroup`, and why one failed."""

from collections.abc import Mapping

from executive.ros.messages import UPRIGHT, header, pose_stamped
from executive.ros.protocol import Message
from executive.types import Pose

DONE = 1
"""`moveit_msgs/msg/MoveItErrorCodes`."""
REASONS: Mapping[int, str] = {
    -1: "I found no motion to there",
    -2: "I found no motion to there",
    -4: "my arm could not follow its motion",
    -6: "it took too long to find a motion",
    -10: "my arm touches something where it is",
    -12: "I would touch something there",
    -31: "I cannot reach there",
}
PLANNING_S, ATTEMPTS = 5.0, 5
_SPHERE = 2
NEAR_M, NEAR_RAD = 0.005, 0.05
"""How exactly the tip gets to where it is sent."""


def to_pose(group: str, tip: str, frame: str, pose: Pose, speed: float) -> Message:
    """A `MotionPlanRequest` for the tip to be at a pose in a frame."""
    there = pose_stamped(pose.position, pose.orientation, frame)["pose"]
    upright = pose_stamped(pose.position, UPRIGHT, frame)["pose"]
    at = {
        "header": header(frame),
        "link_name": tip,
        "constraint_region": {
            "primitives": [{"type": _SPHERE, "dimensions": [NEAR_M]}],
            "primitive_poses": [upright],
        },
        "weight": 1.0,
    }
    turned = {
        "header": header(frame),
        "orientation": there["orientation"],
        "link_name": tip,
        **{f"absolute_{axis}_axis_tolerance": NEAR_RAD for axis in "xyz"},
        "weight": 1.0,
    }
    return _request(
        group, {"position_constraints": [at], "orientation_constraints": [turned]}, speed
    )


def to_joints(group: str, joints: Mapping[str, float], speed: float) -> Message:
    """A `MotionPlanRequest` for joints to be at positions (radians, metres)."""
    constraints = [
        {
            "joint_name": name,
            "position": position,
            "tolerance_above": NEAR_RAD,
            "tolerance_below": NEAR_RAD,
            "weight": 1.0,
        }
        for name, position in joints.items()
    ]
    return _request(group, {"joint_constraints": constraints}, speed)


def _request(group: str, constraints: Message, speed: float) -> Message:
    return {
        "group_name": group,
        "num_planning_attempts": ATTEMPTS,
        "allowed_planning_time": PLANNING_S,
        "max_velocity_scaling_factor": speed,
        "max_acceleration_scaling_factor": speed,
        "goal_constraints": [constraints],
    }


def failure(values: Message) -> str:
    """Why a motion failed by its result, as a clause; empty if it did not, or does not say."""
    told = values.get("error_code")
    code = told.get("val") if isinstance(told, dict) else None
    if not isinstance(code, int) or code in (0, DONE):
        return ""
    return REASONS.get(code, f"my arm failed (MoveIt's error {code})")
