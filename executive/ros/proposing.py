"""A profile for a robot that nobody has described yet, guessed from what it offers."""

from collections.abc import Iterable, Sequence

from executive.ros.offers import Offers
from executive.ros.templates import GOALS
from executive.text import printable

IMAGE = "sensor_msgs/msg/Image"
ACTIONS = {
    "drive": ("nav2_msgs/action/NavigateToPose",),
    "look": ("control_msgs/action/PointHead", "nav2_msgs/action/Spin"),
    "pick": ("executive_msgs/action/Pick",),
    "place": ("executive_msgs/action/Place",),
}
"""The types that each section may have, the best first."""
ARM = {
    "arm": ("moveit_msgs/action/MoveGroup",),
    "gripper": (
        "control_msgs/action/ParallelGripperCommand",
        "control_msgs/action/GripperCommand",
    ),
}
"""The same, for a robot without actions of its own for picking up."""
MOST_FRAMES = 12
"""So many are listed where one is missing."""
UNKNOWN = {
    "arm": ("group", "tip", "carry"),
    "gripper": ("open", "closed", "effort", "opens_m"),
}
"""What else these sections need, and no offer tells: it is asked for."""


PERHAPS = {
    "joints": ("sensor_msgs/msg/JointState", "if velocities are told there: a stop waits for them"),
    "hand": ("std_msgs/msg/Bool", "if that is whether something is in the hand"),
}
"""Sections that no type alone tells to be right: type of the topic, and when they are."""


def proposal(offers: Offers, frames: Iterable[str]) -> str:
    """The TOML of a profile, with what could not be guessed as comments."""
    lines = ["# Proposed from what the robot offers: read it, and put right what is wrong.", ""]
    lines += _frames(tuple(frames))
    for section, kinds in ACTIONS.items():
        lines += _action(offers, section, kinds)
    if not any(offers.actions_of(kind) for kind in ACTIONS["pick"]):
        lines += _arm(offers)
    lines += _camera(offers)
    lines += _section("odometry", {"topic": _first(offers.topics_of("nav_msgs/msg/Odometry"))})
    for section, (kind, why) in PERHAPS.items():
        if found := offers.topics_of(kind):
            lines += [f"# [{section}]  # {why}", f"# topic = {_quoted(found[0])}", ""]
    if offers.topics_of("rosgraph_msgs/msg/Clock"):
        lines += ["[clock]", 'topic = "/clock"', ""]
    return "\n".join(lines)


def listing(offers: Offers) -> str:
    """What the robot offers, a line each."""
    actions = [f"  {name}  {kind or '(type not told)'}" for name, kind in offers.actions.items()]
    topics = [f"  {name}  {kind}" for name, kind in sorted(offers.topics.items())]
    return printable_lines(["actions", *actions, "topics", *topics])


def printable_lines(lines: Iterable[str]) -> str:
    """Lines that a terminal may have."""
    return "\n".join(printable(line) for line in lines)


def _frames(names: tuple[str, ...]) -> list[str]:
    """Where nobody tells a usual one, which there are: a robot may not be localised yet."""
    base = next((n for n in ("base_link", "base_footprint") if n in names), "base_link")
    optical = [n for n in names if n.endswith("optical_frame") or n.endswith("optical")]
    color = next((n for n in optical if "depth" not in n), None)
    there = ", ".join((*names[:MOST_FRAMES], *(["..."] if names[MOST_FRAMES:] else [])))
    untold = f"  # not told; there are {printable(there) or 'none'}"
    return [
        "[frames]",
        'map = "map"' + untold * ("map" not in names),
        f'base = "{base}"' + untold * (base not in names),
        *([f"camera = {_quoted(color)}"] if color else []),
        "",
    ]


def _action(offers: Offers, section: str, kinds: Iterable[str]) -> list[str]:
    for kind in kinds:
        if names := offers.actions_of(kind):
            return _section(section, {"action": names[0], "type": kind})
    untold = [name for name, kind in offers.actions.items() if not kind]
    if section == "drive":
        there = [f"{name} ({kind or 'type not told'})" for name, kind in offers.actions.items()]
        drive = {"action": _first(untold), "type": next(iter(GOALS))}
        return _section("drive", drive, there)
    return []


def _arm(offers: Offers) -> list[str]:
    """Both sections, or none."""
    found = {name: _action(offers, name, kinds) for name, kinds in ARM.items()}
    if not all(found.values()):
        return []
    asked = {name: [f"# {key} = ...  # say which" for key in UNKNOWN[name]] for name in ARM}
    return [line for name, lines in found.items() for line in (*lines[:-1], *asked[name], "")]


def _camera(offers: Offers) -> list[str]:
    images = offers.topics_of(IMAGE)
    depths = [name for name in images if "depth" in name]
    aligned = [name for name in depths if "aligned" in name or "registered" in name]
    colors = [n for n in images if n not in depths and ("color" in n or "rgb" in n)]
    color = _first(colors or [n for n in images if n not in depths])
    infos = offers.topics_of("sensor_msgs/msg/CameraInfo")
    beside = color.rpartition("/")[0] + "/camera_info"
    info = beside if beside in infos else _first(infos)
    others = [name for name in images if name != color]
    topics = {"color": color, "depth": _first(aligned or depths), "info": info}
    return _section("camera", topics, others)


def _section(name: str, keys: dict[str, str], there: Sequence[str] = ()) -> list[str]:
    """The lines of a section; beside what was not found stands what there is instead."""
    lines = [f"{key} = {_quoted(value, there)}" for key, value in keys.items()]
    return [f"[{name}]", *lines, ""]


def _quoted(value: str, there: Sequence[str] = ()) -> str:
    plain = printable(value).replace("\\", "\\\\").replace('"', '\\"')
    if value:
        return f'"{plain}"'
    others = printable(", ".join(there[:MOST_FRAMES]))
    return '""  # not found' + (f"; there is {others}" if others else "")


def _first(names: Iterable[str]) -> str:
    return next(iter(names), "")
