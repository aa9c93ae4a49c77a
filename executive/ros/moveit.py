"""Goals of MoveIt 2's `MoveGroup`, what is around it for it, why one failed; its groups."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree

from executive.geometry import seen_from
from executive.records import Shape
from executive.ros.messages import UPRIGHT, header, pose_stamped
from executive.ros.protocol import Message
from executive.types.geometry import Pose, Vector3

DONE, NO_PLAN, NOT_FOLLOWED, NO_IK = 1, -1, -4, -31
"""`moveit_msgs/msg/MoveItErrorCodes`."""
REASONS: Mapping[int, str] = {
    NO_PLAN: "I found no motion to there",
    -2: "I found no motion to there",
    NOT_FOLLOWED: "my arm could not follow its motion",
    -6: "it took too long to find a motion",
    -7: "somebody else called it off",
    -10: "my arm touches something where it is",
    -12: "I would touch something there",
    -15: "MoveIt does not know the planning group of my arm",
    NO_IK: "I cannot reach there",
}
PLANNING_S, ATTEMPTS = 5.0, 5
SEMANTICS, SEMANTICS_TYPE = "/robot_description_semantic", "std_msgs/msg/String"
"""Where MoveIt tells what it calls parts of the robot, as SRDF."""
_BOX, _SPHERE, _CYLINDER = 1, 2, 3
"""`shape_msgs/msg/SolidPrimitive`."""
NEAR_M, NEAR_RAD = 0.005, 0.05
"""How exactly the tip gets to where it is sent."""


@dataclass(frozen=True, slots=True)
class Obstacle:
    """A solid part of something that stands in the home; its pose is in `map`."""

    name: str
    shape: Shape


@dataclass(frozen=True, slots=True)
class Load:
    """What is in the hand: a box, as the point between the fingers sees it.

    Attributes:
        size: its lengths (metres).
        pose: of its middle, in the frame `tip`.
        touched: the links that touch it.
    """

    size: Vector3
    pose: Pose
    tip: str
    touched: Sequence[str]


def scene(around: Iterable[Obstacle], base: Pose, frame: str, load: Load | None = None) -> Message:
    """A `PlanningScene` that adds to what MoveIt knows: all in the robot's own frames.

    So nothing has to be known of `map` there, and nothing stays there after the goal.
    """
    solids = [
        _solid(f"{one.name}_{number}", one.shape, seen_from(base, one.shape.pose), frame)
        for number, one in enumerate(around)
    ]
    held = [] if load is None else [_attached(load)]
    return {
        "is_diff": True,
        "robot_state": {"is_diff": True, "attached_collision_objects": held},
        "world": {"collision_objects": solids},
    }


def _solid(name: str, shape: Shape, pose: Pose, frame: str) -> Message:
    x, y, z = shape.size
    box = {"type": _BOX, "dimensions": [x, y, z]}
    round_one = {"type": _CYLINDER, "dimensions": [z, x / 2]}
    return {
        "header": header(frame),
        "id": name,
        "primitives": [round_one if shape.kind == "cylinder" else box],
        "primitive_poses": [_pose(pose, frame)],
    }


def _attached(load: Load) -> Message:
    shape = Shape("box", load.size, (0.0, 0.0, 0.0, 1.0))
    return {
        "link_name": load.tip,
        "object": _solid("held", shape, load.pose, load.tip),
        "touch_links": list(load.touched),
    }


def _pose(pose: Pose, frame: str) -> Message:
    found: Message = pose_stamped(pose.position, pose.orientation, frame)["pose"]
    return found


def to_pose(
    group: str, tip: str, frame: str, pose: Pose, speed: float, planner: str = ""
) -> Message:
    """A `MotionPlanRequest` for the tip to be at a pose in a frame; by a PIPELINE/PLANNER."""
    there = _pose(pose, frame)
    upright = _pose(Pose(pose.position, UPRIGHT), frame)
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
    constraints = {"position_constraints": [at], "orientation_constraints": [turned]}
    request = _request(group, constraints, speed)
    if not planner:
        return request
    pipeline, _, name = planner.partition("/")
    return {**request, "pipeline_id": pipeline, "planner_id": name}


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


def planning_groups(srdf: str) -> tuple[str, ...]:
    """The names of the planning groups that an SRDF has.

    Raises:
        xml.etree.ElementTree.ParseError: if it is none.
    """
    found = ElementTree.fromstring(srdf).findall("group")
    return tuple(name for one in found if (name := one.get("name")))
