"""A profile for a robot that nobody has described yet, guessed from what it offers."""

import re
from collections.abc import Iterable, Sequence
from os.path import commonprefix

from executive.ros.messages import FRAMES_TYPE
from executive.ros.offers import Offers
from executive.ros.profile import COMPRESSED, IMAGE, PATH_TYPE, Frames
from executive.ros.templates import GOALS
from executive.text import printable

POINT_HEAD = "control_msgs/action/PointHead"
ACTIONS = {
    "drive": ("nav2_msgs/action/NavigateToPose",),
    "look": (POINT_HEAD, "nav2_msgs/action/Spin"),
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
BASES = ("base_link", "base_footprint")
LEG_M = 2.0
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
    """The TOML of a profile, with what could not be guessed as comments.

    `frames` are those that are told on `frame_topics`.
    """
    lines = ["# Proposed from what the robot offers: read it, and put right what is wrong.", ""]
    lines += _frames(tuple(frames), offers)
    for section, kinds in ACTIONS.items():
        lines += _action(offers, section, kinds)
    if not any(_serving(offers, kind) for kind in ACTIONS["pick"]):
        lines += _arm(offers)
    lines += _camera(offers)
    lines += ["[odometry]", _line("topic", _topics(offers, "nav_msgs/msg/Odometry")), ""]
    for section, (kind, why) in PERHAPS.items():
        if found := _topics(offers, kind):
            lines += [f"# [{section}]  # {why}", f"# {_line('topic', found)}", ""]
    if clocks := _topics(offers, "rosgraph_msgs/msg/Clock"):
        lines += ["[clock]", _line("topic", clocks), ""]
    return "\n".join(lines)


def frame_topics(offers: Offers) -> tuple[str, str]:
    """The topics that tell where the robot is: by frames that move, and by those that do not."""
    told = _topics(offers, FRAMES_TYPE)
    fixed = [name for name in told if name.endswith("static")]
    moving = [name for name in told if name not in fixed]
    usual = Frames()
    return next(iter(moving), usual.tf), next(iter(fixed), usual.tf_static)


def listing(offers: Offers) -> str:
    """What the robot offers, a line each."""
    actions = [f"  {name}  {kind or '(type not told)'}" for name, kind in offers.actions.items()]
    topics = [f"  {name}  {kind}" for name, kind in sorted(offers.topics.items())]
    return printable_lines(["actions", *actions, "topics", *topics])


def printable_lines(lines: Iterable[str]) -> str:
    """Lines that a terminal may have."""
    return "\n".join(printable(line) for line in lines)


# --- which of several ---


def _near(names: Iterable[str], to: str) -> tuple[str, ...]:
    """Those in the same namespace as another name first: there may be more robots, and cameras."""
    return tuple(sorted(names, key=lambda name: (-_shared(name, to), name.count("/"))))


def _shared(one: str, other: str) -> int:
    """How much of their namespaces two names share."""
    return len(commonprefix([one.split("/")[:-1], other.split("/")[:-1]]))


def _serving(offers: Offers, kind: str) -> tuple[str, ...]:
    """The actions of this type; of those whose type is not told, such as are called like it."""
    words = re.sub(r"(?<!^)(?=[A-Z])", "_", kind.rpartition("/")[2]).lower()
    like = re.compile(rf".*/{words}(_\w+)?")
    called = (name for name, told in offers.actions.items() if not told and like.fullmatch(name))
    return offers.actions_of(kind) or tuple(called)


def _driver(offers: Offers) -> str:
    """The action that drives the robot; what else it has is near that."""
    return next(iter(_near(_serving(offers, ACTIONS["drive"][0]), "")), "")


def _topics(offers: Offers, kind: str) -> tuple[str, ...]:
    return _near(offers.topics_of(kind), _driver(offers))


# --- the sections ---


def _frames(names: tuple[str, ...], offers: Offers) -> list[str]:
    """Where nobody tells a usual one, which there are: a robot may not be localised yet."""
    optical = [n for n in names if n.endswith("optical_frame") or n.endswith("optical")]
    of_color = [n for n in optical if "color" in n or "rgb" in n]
    eyes = of_color or [n for n in optical if "depth" not in n]
    there = _listed(names) or "none"
    lines = ["[frames]"]
    for key, usual in (("map", ("map",)), ("base", BASES)):
        found = [f"/{name}" for one in usual for name in names if name.rpartition("/")[2] == one]
        name = next((one[1:] for one in _near(found, _driver(offers))), "")
        lines.append(
            f"{key} = {_quoted(name or usual[0])}" + f"  # not told; there are {there}" * (not name)
        )
    if len(eyes) == 1 and _serving(offers, POINT_HEAD):  # others go by what pictures say
        lines.append(f"camera = {_quoted(eyes[0])}")
    usual_topics = Frames()
    for key, topic in zip(("tf", "tf_static"), frame_topics(offers), strict=True):
        if topic != getattr(usual_topics, key):
            lines.append(_line(key, (topic,)))
    return [*lines, ""]


def _action(offers: Offers, section: str, kinds: Iterable[str]) -> list[str]:
    for kind in kinds:
        if names := _near(_serving(offers, kind), _driver(offers)):
            legs = _legs(offers) if section == "drive" else []
            guessed = "" if offers.actions[names[0]] else "  # not told: by its name"
            typed = _line("type", (kind,)) + guessed
            return [f"[{section}]", _line("action", names), typed, *legs, ""]
    if section == "drive":
        there = [f"{name} ({kind or 'type not told'})" for name, kind in offers.actions.items()]
        guessed = _line("type", (next(iter(GOALS)),))
        return ["[drive]", _line("action", (), there), guessed, ""]
    return []


def _legs(offers: Offers) -> list[str]:
    """A link that is lost then means metres, not rooms; by ways of the same robot's."""
    driver = _driver(offers)
    beside = driver.rpartition("/")[0]
    ways = [name for name in _serving(offers, PATH_TYPE) if name.rpartition("/")[0] == beside]
    return [_line("path", ways), f"leg_m = {LEG_M}"] if ways else []


def _arm(offers: Offers) -> list[str]:
    """Both sections, or none."""
    found = {name: _action(offers, name, kinds) for name, kinds in ARM.items()}
    if not all(found.values()):
        return []
    asked = {name: [f"# {key} = ...  # say which" for key in UNKNOWN[name]] for name in ARM}
    return [line for name, lines in found.items() for line in (*lines[:-1], *asked[name], "")]


def _camera(offers: Offers) -> list[str]:
    """The colour that has a depth next to it, if there is one, and both of the same camera."""
    images, packed = _topics(offers, IMAGE), _topics(offers, COMPRESSED)
    depths, colors = _parted(images)
    packed_depths, packed_colors = _parted(packed)
    both = (("color", colors, packed_colors), ("depth", depths, packed_depths))
    compressed = [_quoted(key) for key, plain, other in both if other and not plain]
    depths = depths or _packed_as("compressedDepth", packed_depths)
    colors = colors or _packed_as("compressed", packed_colors)
    aligned = [name for name in depths if "aligned" in name or "registered" in name] or depths
    colors = [name for name in colors if "color" in name or "rgb" in name] or colors
    colors.sort(key=lambda name: -max((_shared(name, depth) for depth in aligned), default=0))
    color = next(iter(colors), "")
    others = [name for name in (*images, *packed) if name != color]
    infos = _near(offers.topics_of("sensor_msgs/msg/CameraInfo"), color)
    return [
        "[camera]",
        _line("color", colors, others),
        _line("depth", _near(aligned, color), others),
        _line("info", infos[:1], others),
        *([f"compressed = [{', '.join(compressed)}]"] if compressed else []),
        "",
    ]


def _parted(images: Iterable[str]) -> tuple[list[str], list[str]]:
    """Those of depth, and the others."""
    depths = [name for name in images if "depth" in name]
    return depths, [name for name in images if name not in depths]


def _packed_as(transport: str, names: list[str]) -> list[str]:
    """Those that image_transport calls so, if it is it that packs them."""
    return [name for name in names if name.rpartition("/")[2] == transport] or names


def _line(key: str, names: Sequence[str], there: Sequence[str] = ()) -> str:
    """A key with the first of these names; beside it stands what else it may be.

    Beside what was not found stands what there is instead.
    """
    if names:
        also = _listed(names[1:])
        return f"{key} = {_quoted(names[0])}" + (f"  # or {also}" if also else "")
    instead = _listed(there)
    return f'{key} = ""  # not found' + (f"; there is {instead}" if instead else "")


def _listed(names: Sequence[str]) -> str:
    return printable(", ".join((*names[:MOST_FRAMES], *(["..."] if names[MOST_FRAMES:] else []))))


def _quoted(value: str) -> str:
    plain = printable(value).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{plain}"'
