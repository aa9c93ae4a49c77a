"""Whether a profile's goals fit their actions' types, as far as the robot tells them."""

from collections.abc import Iterator, Mapping
from typing import Any

from executive.errors import InputError
from executive.ros.link import Link, LinkError
from executive.ros.offers import Offers
from executive.ros.profile import Profile
from executive.ros.protocol import Message

SERVICE, KIND = "/rosapi/action_goal_details", "rosapi_msgs/srv/ActionGoalDetails"
"""Not every rosapi has it."""
ASKING_S = 5.0
TEXT = ("string", "wstring")
TRUTH = ("boolean", "bool")
NUMBER = ("double", "float64", "float", "float32")
WHOLE = (*(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)), "byte", "octet")
WORDS: Mapping[str, tuple[str, ...]] = {
    "pose": ("geometry_msgs/PoseStamped",),
    "point": ("geometry_msgs/PointStamped",),
    "points": ("sensor_msgs/PointCloud2",),
    "request": ("moveit_msgs/MotionPlanRequest",),
    "scene": ("moveit_msgs/PlanningScene",),
    **dict.fromkeys(("place", "label", "camera", "joint"), TEXT),
    **dict.fromkeys(("turn", "confidence", "position", "effort"), NUMBER),
    "cut_off": TRUTH,
}
"""The types that a field may have in which these stand."""
Fields = Mapping[str, Mapping[str, str]]
"""By the type of a message: the types of its fields; of an array, that of an element."""


async def misfits(link: Link, offers: Offers, profile: Profile, where: str) -> list[InputError]:
    """All that stands in a goal of the profile, and has no place in the action's type."""
    found = []
    for section, action in profile.actions().items():
        if action.goal and SERVICE in offers.services:
            kind, fields = await _told(link, action.type)
            for what, right in _misfits(action.goal, kind, fields):
                found.append(InputError(where, f"{section}.goal: {what}", right))
    return found


async def _told(link: Link, action: str) -> tuple[str, Fields]:
    """The type of an action's goal and of all that it consists of; nothing if nobody tells it."""
    try:
        answer = await link.call(SERVICE, KIND, {"type": action}, within_s=ASKING_S)
        return _read(answer)
    except (LinkError, LookupError, TypeError, ValueError):
        return "", {}


def _read(answer: Message) -> tuple[str, Fields]:
    """Of `rosapi_msgs/msg/TypeDef`, the goal's own comes first."""
    fields = {
        str(one["type"]): dict(zip(one["fieldnames"], one["fieldtypes"], strict=True))
        for one in answer["typedefs"]
    }
    return next(iter(fields), ""), fields


def _misfits(goal: Mapping[str, Any], kind: str, fields: Fields) -> Iterator[tuple[str, str]]:
    """What is wrong, and what would be right."""
    if kind not in fields:
        return
    for name, value in goal.items():
        if name not in fields[kind]:
            there = ", ".join(f"{one} ({told})" for one, told in fields[kind].items())
            yield f"{kind} has no field {name}", f"it has {there}"
            continue
        told = fields[kind][name]
        for one in value if isinstance(value, list) else [value]:
            if isinstance(one, Mapping):
                yield from _misfits(one, told, fields)
            elif (may_be := _kinds(one)) and told not in may_be:
                fit = [f"${word}" for word, kinds in WORDS.items() if told in kinds]
                yield f"{name} is {told} in {kind}, and {one} is not", " or ".join(fit)


def _kinds(value: Any) -> tuple[str, ...]:
    """The types that a field with this value may have; none if any will do."""
    match value:
        case bool():
            return TRUTH
        case str() if value.startswith("$"):
            return WORDS.get(value[1:], ())
        case str():
            return TEXT
        case int():
            return (*WHOLE, *NUMBER)
        case _:
            return NUMBER
