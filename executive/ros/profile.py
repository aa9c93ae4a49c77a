"""What a robot calls things, and what it has: a TOML file that one writes for a new robot.

Names that this project does not know are given here, and nothing of them stands in the code.
"""

from collections.abc import Iterable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator
from pydantic_core import ErrorDetails

from executive.errors import InputError
from executive.files import read_bytes
from executive.ros.templates import GOALS, OFFERED, WANTED, is_finite, placeholders
from executive.toml_file import (
    MOST_BYTES,
    in_words,
    packaged,
    parse_toml,
    refuse_misread_bools,
    shown,
)

EXAMPLE = "see docs/own-robot.md"
IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
PATH_TYPE = "nav2_msgs/action/ComputePathToPose"
"""Of the action that plans ways."""


def _graph_name(name: str) -> str:
    if not (name.startswith("/") and name.isprintable() and " " not in name and len(name) < 256):
        raise ValueError("should begin with / and have no spaces, as in `ros2 topic list`")
    return name


def _type_name(name: str) -> str:
    parts = name.split("/")
    if not (len(parts) == 3 and all(part.isidentifier() for part in parts)):
        raise ValueError("should be PACKAGE/action/NAME or PACKAGE/msg/NAME")
    return name


class _Section(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @field_validator(
        *("action", "topic", "color", "depth", "info", "path", "tf", "tf_static", "speed_topic"),
        check_fields=False,
    )
    @classmethod
    def _names(cls, value: str | None) -> str | None:
        return None if value is None else _graph_name(value)

    @field_validator("type", check_fields=False)
    @classmethod
    def _types(cls, value: str) -> str:
        return _type_name(value)


class Frames(_Section):
    """Names of frames, and the topics that tell where they are."""

    map: Annotated[str, Field(min_length=1)] = "map"
    """The home file's frame: the robot has to be localised in it."""
    base: Annotated[str, Field(min_length=1)] = "base_link"
    camera: str = ""
    """The optical frame; empty: the one that pictures say."""
    tf: str = "/tf"
    tf_static: str = "/tf_static"


class Action(_Section):
    """An action of the robot's.

    Attributes:
        action: its name.
        type: its type.
        goal: the goal's fields, where `$pose` and the like stand for what is meant; may be left
            out for a type that is known.
        silent_s: after so long (s, real time) without any sign of it a goal is given up: a server
            that refuses goals may never say so.
    """

    action: str
    type: str
    goal: dict[str, Any] = Field(default_factory=dict)
    silent_s: Annotated[float, Field(gt=0, le=3600)] = 30.0

    @field_validator("goal")
    @classmethod
    def _plain(cls, value: dict[str, Any]) -> dict[str, Any]:
        if not is_finite(value):
            raise ValueError("inf and nan cannot be sent")
        return value

    @property
    def template(self) -> Mapping[str, Any]:
        """The goal, with `$` before what is to be put in."""
        return self.goal or GOALS.get(self.type, {})


class Drive(Action):
    """Driving; in legs, if the robot plans ways for others.

    A link that is lost then means so many metres at most: nobody can stop the robot meanwhile.
    """

    path: str | None = None
    """Action of type `PATH_TYPE`."""
    leg_m: Annotated[float, Field(ge=0.2, le=100)] | None = None

    @model_validator(mode="after")
    def _legs_need_a_path(self) -> Self:
        if self.leg_m is not None and self.path is None:
            raise ValueError("leg_m needs path, the action that plans ways: /compute_path_to_pose")
        return self


class Look(Action):
    """Turning the head, or all of the robot.

    Attributes:
        views: how many looks it takes to see a place; left out: one for each of its surfaces.
        joints: of a head that follows trajectories: the one that turns it to the left, and the one
            that turns it down.
        mount: the frame that carries these joints, with x ahead and z up.
    """

    views: Annotated[int, Field(ge=1, le=20)] | None = None
    joints: tuple[str, str] | None = None
    mount: str = ""

    @model_validator(mode="after")
    def _trajectories_need_joints(self) -> Self:
        if "$angles" in str(self.template) and not (self.joints and self.mount):
            raise ValueError("joints and mount are missing: which joints turn the head, on what")
        return self


class ArmAction(Action):
    """Motions of the arm, by MoveIt 2: for a robot that has no action of its own for picking up.

    Attributes:
        group: MoveIt's planning group.
        tip: the frame of the point between the fingers; z points out of the hand, y to a finger.
        carry: positions of the joints in which things are carried (radians, metres).
        speed: part of the greatest one.
        near_m: how near the front edge of furniture the middle of the robot stands to reach for
            what is on it (metres); left out: it reaches from where it stopped to look.
        straight: PIPELINE/PLANNER that moves the hand in a straight line, for the last part; left
            out: MoveIt's default planner does that, too.
    """

    group: Annotated[str, Field(min_length=1)]
    tip: Annotated[str, Field(min_length=1)]
    carry: dict[str, Annotated[float, Field(ge=-100, le=100)]] = Field(min_length=1)
    speed: Annotated[float, Field(gt=0, le=1)] = 0.2
    near_m: Annotated[float, Field(ge=0.1, le=2)] | None = None
    straight: str = ""

    @field_validator("straight")
    @classmethod
    def _pipeline_and_planner(cls, value: str) -> str:
        if value and not all(value.partition("/")):
            raise ValueError("should be like pilz_industrial_motion_planner/LIN")
        return value


class GripperAction(Action):
    """The gripper. Something is held if it stalls before it is closed.

    Attributes:
        open: the command that opens it.
        closed: the command that closes it.
        effort: the greatest one (as the action has it).
        newtons: whether that is what a finger presses with: light things are then held gently.
        joint: for ParallelGripperCommand: the joint's name.
        opens_m: how far it opens (metres).
        links: of the hand, which touch what is held: MoveIt then keeps that clear of the furniture,
            too; left out: it knows nothing of it.
    """

    open: Annotated[float, Field(ge=-1000, le=1000)]
    closed: Annotated[float, Field(ge=-1000, le=1000)]
    effort: Annotated[float, Field(ge=-1, le=10_000)]
    newtons: bool = False
    joint: str = ""
    opens_m: Annotated[float, Field(gt=0, le=1)]
    links: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _opens_and_has_a_joint(self) -> Self:
        if self.open == self.closed:
            raise ValueError("open and closed are the same: which commands open and close it")
        if self.newtons and not self.effort > 0:
            raise ValueError("effort is not above 0: how hard a finger may press (newtons)")
        if "$joint" in str(self.template) and not self.joint:
            raise ValueError("joint is missing: the name of the gripper's joint, as goals have it")
        return self


class Hand(_Section):
    """What tells whether something is in the hand.

    A topic of type std_msgs/msg/Bool; or of sensor_msgs/msg/JointState, with the name of a finger's
    joint and the positions between which something keeps it open.
    """

    topic: str
    joint: str = ""
    between: tuple[float, float] | None = None

    @model_validator(mode="after")
    def _joint_needs_between(self) -> Self:
        if bool(self.joint) != (self.between is not None):
            raise ValueError("joint and between belong together: give both, or neither")
        if self.between is not None and not self.between[0] < self.between[1]:
            raise ValueError("between should be two positions, the smaller one first")
        return self

    @property
    def type(self) -> str:
        """Of its messages."""
        return "sensor_msgs/msg/JointState" if self.joint else "std_msgs/msg/Bool"


class CameraTopics(_Section):
    """Colour, depth that is aligned with it, and the lens.

    `compressed` says which of both come as sensor_msgs/msg/CompressedImage; `in_map` whether depth
    and frames tell where things are, and `tags` whether things look like tags that spell their
    names: both are for the instant world.
    """

    color: str
    depth: str
    info: str
    compressed: tuple[Literal["color", "depth"], ...] = ()
    in_map: bool = True
    tags: bool = False
    late_s: Annotated[float, Field(gt=0, le=60)] = 5.0
    """A picture that takes longer (s, real time) does not come."""

    def image_type(self, of: Literal["color", "depth"]) -> str:
        """The type of these messages."""
        return COMPRESSED if of in self.compressed else IMAGE


class Topic(_Section):
    """A topic."""

    topic: str


class ClockTopic(_Section):
    """The robot's own time, if it is simulated."""

    topic: str = "/clock"
    counts_while_idle: bool = True
    """Whether its time is mission time, too, while nothing is under way."""


class Limits(_Section):
    """What the robot keeps to, whatever it is asked.

    Attributes:
        rooms: the rooms of the home that it may be sent to; left out: all.
        hours: from when until when it drives, local time: `["08:00", "20:00"]`.
        speed_m_s: published once to `speed_topic`, which Nav2 heeds.
    """

    rooms: tuple[str, ...] | None = None
    hours: tuple[str, str] | None = None
    speed_m_s: Annotated[float, Field(gt=0, le=10)] | None = None
    speed_topic: str = "/speed_limit"

    @field_validator("hours")
    @classmethod
    def _times(cls, value: tuple[str, str] | None) -> tuple[str, str] | None:
        for one in value or ():
            hour, colon, minute = one.partition(":")
            fits = colon and one.isascii() and hour.isdigit() and minute.isdigit() and len(one) == 5
            if not fits or int(hour) > 23 or int(minute) > 59:
                raise ValueError('should be like ["08:00", "20:00"]')
        if value is not None and value[0] == value[1]:
            raise ValueError("should end at another time than it begins; left out: at any time")
        return value


class Profile(_Section):
    """What a robot has and what it is called."""

    about: str = ""
    tried: str = "not on hardware"
    """Where this was tried, for who reads it."""
    link_wait_s: Annotated[float, Field(ge=0, le=3600)] = 30.0
    """So long a link that was lost is waited for (s, real time), before the mission ends."""
    frames: Frames = Frames()
    drive: Drive
    look: Look | None = None
    pick: Action | None = None
    place: Action | None = None
    arm: ArmAction | None = None
    gripper: GripperAction | None = None
    hand: Hand | None = None
    camera: CameraTopics
    odometry: Topic
    joints: Topic | None = None
    clock: ClockTopic | None = None
    limits: Limits = Limits()

    @model_validator(mode="after")
    def _goals_are_known(self) -> Self:
        for section, action in self.actions().items():
            if not action.template:
                known = ", ".join(GOALS)
                raise ValueError(
                    f"{section}.goal is missing: I know only the goals of {known}; "
                    "write what goes into its fields"
                )
            words, wanted = placeholders(action.template), WANTED.get(section, ())
            for word in words:
                if word not in OFFERED[section]:
                    offered = _listed(OFFERED[section])
                    raise ValueError(f"{section}.goal has ${word}; there are {offered}")
            if wanted and not set(words) & set(wanted):
                raise ValueError(
                    f"{section}.goal has none of {_listed(wanted)}: all would be the same"
                )
        if (self.pick is None) != (self.place is None):
            raise ValueError("pick and place belong together: give both, or neither")
        if (self.arm is None) != (self.gripper is None):
            raise ValueError("arm and gripper belong together: give both, or neither")
        if self.arm is not None and self.pick is not None:
            raise ValueError("give pick and place, or arm and gripper, not all of them")
        return self

    def actions(self) -> dict[str, Action]:
        """The actions by their sections: all that can be under way, and has to be stopped."""
        sections: dict[str, Action | None] = {
            "drive": self.drive,
            "look": self.look,
            "pick": self.pick,
            "place": self.place,
            "arm": self.arm,
            "gripper": self.gripper,
        }
        return {name: action for name, action in sections.items() if action is not None}

    @property
    def has_arm(self) -> bool:
        """Whether it can take things."""
        return self.pick is not None or self.arm is not None


def _listed(words: Iterable[str]) -> str:
    return ", ".join(f"${one}" for one in words)


# --- reading ---


def packaged_profiles() -> tuple[str, ...]:
    """Names of the profiles that come with the project."""
    return packaged("executive.ros", "profiles")


def profile_text(name_or_path: str) -> tuple[bytes, str]:
    """A profile's file, and what to call it in messages.

    Raises:
        InputError: if there is none.
    """
    known = f"packaged are {', '.join(packaged_profiles())}"
    if name_or_path.endswith(".toml"):
        return read_bytes(Path(name_or_path), MOST_BYTES, right=known), name_or_path
    if name_or_path in packaged_profiles():
        file = files("executive.ros").joinpath("profiles", f"{name_or_path}.toml")
        return file.read_bytes(), file.name
    right = f"{known}; or give the path of a .toml file"
    raise InputError(f"--profile {name_or_path[:80]}", "there is no profile of this name", right)


def load_profile(name_or_path: str) -> Profile:
    """Read a profile: the name of a packaged one, or a TOML file.

    Raises:
        InputError: if there is none or something in it is wrong, naming file and key.
    """
    content, where = profile_text(name_or_path)
    tables = parse_toml(content, where)
    try:
        profile = Profile.model_validate(tables)
    except ValidationError as error:
        raise _input_error(where, error.errors(include_url=False)[0]) from None
    refuse_misread_bools(tables, profile, where)
    return profile


def _input_error(where: str, fault: ErrorDetails) -> InputError:
    key = ".".join(str(part) for part in fault["loc"])[:80]
    said = in_words(fault["msg"])
    match fault["type"]:
        case "extra_forbidden":
            return InputError(where, f"there is no key {key}", EXAMPLE)
        case "missing":
            return InputError(where, f"{key} is missing", EXAMPLE)
        case "value_error" if not isinstance(fault["input"], str | list | tuple):
            return InputError(where, f"{key}: {said}" if key else said)
        case kind:
            right = said if kind == "value_error" else said.lower()
            return InputError(where, f"{key} is {shown(fault['input'])}", right)
