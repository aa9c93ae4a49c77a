"""Goals of actions as templates: `$pose` and the like stand for what is put in."""

import math
from collections.abc import Mapping
from typing import Any

GOALS: Mapping[str, Mapping[str, Any]] = {
    "nav2_msgs/action/NavigateToPose": {"pose": "$pose"},
    "nav2_msgs/action/Spin": {"target_yaw": "$turn"},
    "control_msgs/action/PointHead": {
        "target": "$point",
        "pointing_frame": "$camera",
        "pointing_axis": {"x": 0.0, "y": 0.0, "z": 1.0},
    },
    "control_msgs/action/FollowJointTrajectory": {
        "trajectory": {
            "joint_names": "$joints",
            "points": [{"positions": "$angles", "time_from_start": {"sec": 1, "nanosec": 0}}],
        }
    },
    "moveit_msgs/action/MoveGroup": {
        "request": "$request",
        "planning_options": {
            "planning_scene_diff": "$scene",
            "plan_only": False,
            "replan": True,
            "replan_attempts": 2,
        },
    },
    "control_msgs/action/GripperCommand": {
        "command": {"position": "$position", "max_effort": "$effort"}
    },
    "control_msgs/action/ParallelGripperCommand": {
        "command": {"name": ["$joint"], "position": ["$position"], "effort": ["$effort"]}
    },
    "executive_msgs/action/Pick": {
        "label": "$label",
        "points": "$points",
        "confidence": "$confidence",
        "cut_off": "$cut_off",
    },
    "executive_msgs/action/Place": {"place": "$place"},
}
"""The goals of types that are known; another type's is given by the profile."""
OFFERED: Mapping[str, tuple[str, ...]] = {
    "drive": ("pose", "place"),
    "look": ("point", "turn", "camera", "place", "joints", "angles"),
    "pick": ("label", "points", "confidence", "cut_off", "point", "pose", "place"),
    "place": ("point", "pose", "place"),
    "arm": ("request", "scene"),
    "gripper": ("position", "effort", "joint"),
}
"""What stands for what in a goal, by section: `$pose` and so on."""
WANTED: Mapping[str, tuple[str, ...]] = {
    "drive": ("pose", "place"),
    "look": ("point", "turn", "angles", "place"),
    "pick": ("label", "points", "point", "pose"),
    "arm": ("request",),
    "gripper": ("position",),
}
"""One of these is in each goal of a section, or all its goals are the same."""


def placeholders(value: Any) -> tuple[str, ...]:
    """What stands after `$` in a template."""
    match value:
        case str() if value.startswith("$"):
            return (value[1:],)
        case Mapping():
            return tuple(word for one in value.values() for word in placeholders(one))
        case list():
            return tuple(word for one in value for word in placeholders(one))
        case _:
            return ()


def is_finite(value: Any) -> bool:
    """Whether all numbers in a template are such as can be sent."""
    match value:
        case float():
            return math.isfinite(value)
        case Mapping():
            return all(map(is_finite, value.values()))
        case list():
            return all(map(is_finite, value))
        case _:
            return True


def filled(template: Any, values: Mapping[str, Any]) -> Any:
    """The template with the values put in where `$` and their names stand."""
    match template:
        case str() if template.startswith("$"):
            return values[template[1:]]
        case Mapping():
            return {key: filled(one, values) for key, one in template.items()}
        case list():
            return [filled(one, values) for one in template]
        case _:
            return template
