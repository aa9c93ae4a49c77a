"""The kinds of faults that can be injected, and their syntax: `moved=mug:desk@12`, `blind@20-40`.

    WORD[=VALUE][@FROM[-TO]]        times in seconds of the mission; without any: always

This module only parses and checks them. `injector` applies them to the world, the sensors and the
motors. The behaviour tree is never told of a fault; it only sees the consequences.
"""

import math
from collections.abc import Iterable
from dataclasses import KW_ONLY, dataclass
from typing import ClassVar, Self

from executive.errors import InputError
from executive.types.geometry import Pose
from executive.types.home import DELIVERY
from sim.home.arrangement import NoRoomError
from sim.home.floorplan import doors_between
from sim.home.home import Home

JOINTS = ("lift", *(f"joint{i}" for i in range(1, 8)))
"""The joints that can get stuck, in the order of `sim.body.hardware.ARM`."""


@dataclass(frozen=True, slots=True)
class Span:
    """An interval of mission time (s): `start` is included, `end` is not."""

    start: float = 0.0
    end: float = math.inf

    @classmethod
    def parse(cls, text: str) -> Self:
        """Parse `12` or `12-40`.

        Raises:
            ValueError: if the text is neither.
        """
        start, dash, end = text.partition("-")
        span = cls(_number(start), _number(end) if dash else math.inf)
        if not 0 <= span.start < span.end:
            raise ValueError(f"{text} is no time from 0 on, or none that ends after it begins")
        return span

    def __contains__(self, time_s: float) -> bool:
        """Whether a time (s) is in the interval."""
        return self.start <= time_s < self.end

    def __str__(self) -> str:
        """The text that `parse` reads, with `@` before it; empty if the fault is always active."""
        end = "" if self.end == math.inf else f"-{self.end:g}"
        return f"@{self.start:g}{end}" if self != Span() else ""


@dataclass(frozen=True, slots=True)
class Fault:
    """A fault to inject.

    Attributes:
        word: its name in the syntax.
        example: a valid text, for messages.
        physical: whether it needs the physics world.
        during: when it is active.
    """

    word: ClassVar[str]
    example: ClassVar[str]
    physical: ClassVar[bool] = False
    _: KW_ONLY
    during: Span = Span()

    @property
    def value(self) -> str:
        """The text after the equals sign; empty if there is none."""
        return ""

    @classmethod
    def parse(cls, value: str, during: Span) -> Self:
        """Parse the value.

        Raises:
            ValueError: if the value is not valid for this fault.
        """
        if value:
            raise ValueError(f"{cls.word} takes no value")
        return cls(during=during)

    def check(self, home: Home) -> None:
        """Check that the home has the objects, places or rooms that the fault names.

        Raises:
            ValueError: if not; the text lists what the home has.
        """

    def __str__(self) -> str:
        """The text that `parse_fault` reads."""
        equals = f"={self.value}" if self.value else ""
        return f"{self.word}{equals}{self.during}"


# --- the world ---


@dataclass(frozen=True, slots=True)
class Moved(Fault):
    """A person takes an object to another place, unless the robot holds it."""

    word: ClassVar[str] = "moved"
    example: ClassVar[str] = "moved=mug:desk@12"
    thing: str
    place: str

    @property
    def value(self) -> str:
        """Object and place."""
        return f"{self.thing}:{self.place}"

    @classmethod
    def parse(cls, value: str, during: Span) -> Self:
        """Parse `mug:desk`."""
        thing, colon, place = value.partition(":")
        if not (thing and colon and place):
            raise ValueError("should name a thing and a place")
        return cls(thing, place, during=during)

    def check(self, home: Home) -> None:
        """Both must exist, and there must be room for the object."""
        if self.thing not in home.objects:
            raise ValueError(f"there is no {self.thing} in this home; there is {_of(home.objects)}")
        places = (*(piece.name for piece in home.furniture), DELIVERY)
        if self.place not in places:
            raise ValueError(f"there is no {self.place} in this home; there is {_of(places)}")
        try:
            self.pose(home)
        except NoRoomError as error:
            raise ValueError(str(error)) from None

    def pose(self, home: Home) -> Pose:
        """The object's new pose in `map`, on a spot that no other object has at the start.

        Raises:
            NoRoomError: if there is no free spot.
        """
        others = {name: spot for name, spot in home.objects.items() if name != self.thing}
        objects = {**others, self.thing: home.objects[self.thing].moved(self.place)}
        return home.model_copy(update={"objects": objects}).object_pose(self.thing)


@dataclass(frozen=True, slots=True)
class Blocked(Fault):
    """The door between two rooms is shut."""

    word: ClassVar[str] = "blocked"
    example: ClassVar[str] = "blocked=kitchen-lobby@5-60"
    rooms: tuple[str, str]

    @property
    def value(self) -> str:
        """Both rooms."""
        return "-".join(self.rooms)

    @classmethod
    def parse(cls, value: str, during: Span) -> Self:
        """Parse `kitchen-lobby`."""
        one, dash, other = value.partition("-")
        if not (one and dash and other):
            raise ValueError("should name the two rooms of a door")
        return cls((one, other), during=during)

    def check(self, home: Home) -> None:
        """There must be a door between them."""
        doors = doors_between(home.rooms, home.doors)
        if not any(set(self.rooms) == set(rooms) for rooms in doors.values()):
            known = _of("-".join(rooms) for rooms in doors.values())
            raise ValueError(f"there is no door {self.value}; there is {known}")


@dataclass(frozen=True, slots=True)
class Crate(Fault):
    """A person puts a crate on the floor, at a point of `map` (metres)."""

    word: ClassVar[str] = "crate"
    example: ClassVar[str] = "crate=2.5,4.5@5-60"
    physical: ClassVar[bool] = True
    x: float
    y: float

    @property
    def value(self) -> str:
        """The point."""
        return f"{self.x:g},{self.y:g}"

    @classmethod
    def parse(cls, value: str, during: Span) -> Self:
        """Parse `2.5,4.5`."""
        x, _, y = value.partition(",")
        return cls(_number(x), _number(y), during=during)

    def check(self, home: Home) -> None:
        """The point must be in a room."""
        if not any(room.holds(self.x, self.y) for room in home.rooms):
            raise ValueError(f"({self.value}) is in no room")


# --- hand and arm ---


@dataclass(frozen=True, slots=True)
class Rated(Fault):
    """A fault that strikes with a probability, drawn at each occasion."""

    rate: float

    @property
    def value(self) -> str:
        """The probability."""
        return f"{self.rate:g}"

    @classmethod
    def parse(cls, value: str, during: Span) -> Self:
        """Parse `0.3`."""
        return cls(_up_to_one(value, "a probability"), during=during)


@dataclass(frozen=True, slots=True)
class Slip(Rated):
    """The fingers have almost no friction, and lose the object that they close on."""

    word: ClassVar[str] = "slip"
    example: ClassVar[str] = "slip=0.3"


@dataclass(frozen=True, slots=True)
class Drop(Fault):
    """The hand drops, once, the object that it carries at this time or picks up later."""

    word: ClassVar[str] = "drop"
    example: ClassVar[str] = "drop@45"


@dataclass(frozen=True, slots=True)
class Stuck(Fault):
    """A joint of the arm, or its lift, does not move."""

    word: ClassVar[str] = "stuck"
    example: ClassVar[str] = "stuck=joint3@20"
    joint: str

    @property
    def value(self) -> str:
        """The joint, without the prefix `panda_`."""
        return self.joint

    @classmethod
    def parse(cls, value: str, during: Span) -> Self:
        """Parse `joint3` or `lift`."""
        if value not in JOINTS:
            raise ValueError(f"there is no joint {value!r}; there is {_of(JOINTS)}")
        return cls(value, during=during)

    @property
    def index(self) -> int:
        """Its index in `sim.body.hardware.ARM`."""
        return JOINTS.index(self.joint)


# --- camera and detector ---


@dataclass(frozen=True, slots=True)
class Blind(Fault):
    """The camera takes black pictures without depth."""

    word: ClassVar[str] = "blind"
    example: ClassVar[str] = "blind@20-40"


@dataclass(frozen=True, slots=True)
class Noise(Fault):
    """The camera's pictures are noisy.

    `deviation` is the standard deviation of the depth (metres) and of the colours (of full scale).
    """

    word: ClassVar[str] = "noise"
    example: ClassVar[str] = "noise=0.02"
    deviation: float

    @property
    def value(self) -> str:
        """The standard deviation."""
        return f"{self.deviation:g}"

    @classmethod
    def parse(cls, value: str, during: Span) -> Self:
        """Parse `0.02`."""
        return cls(_up_to_one(value, "a standard deviation in metres"), during=during)


@dataclass(frozen=True, slots=True)
class Miss(Rated):
    """The detector overlooks an object in a picture."""

    word: ClassVar[str] = "miss"
    example: ClassVar[str] = "miss=0.2"


@dataclass(frozen=True, slots=True)
class Confuse(Rated):
    """The detector gives an object in a picture the name of another object of the home."""

    word: ClassVar[str] = "confuse"
    example: ClassVar[str] = "confuse=0.1"


FAULTS: dict[str, type[Fault]] = {
    kind.word: kind
    for kind in (Moved, Blocked, Crate, Slip, Drop, Stuck, Blind, Noise, Miss, Confuse)
}
"""All kinds of faults, by their words."""


def parse_fault(text: str) -> Fault:
    """Parse one fault.

    Raises:
        InputError: if the text is not valid, with an example of what would be right.
    """
    what, at, when = text.partition("@")
    word, _, value = what.partition("=")
    if word not in FAULTS:
        raise InputError(f"--fault {text}", f"there is no fault {word!r}", f"known: {_of(FAULTS)}")
    kind = FAULTS[word]
    try:
        return kind.parse(value, Span.parse(when) if at else Span())
    except ValueError as error:
        raise InputError(f"--fault {text}", str(error), f"as in {kind.example}") from None


def parse_faults(texts: Iterable[str], home: Home) -> tuple[Fault, ...]:
    """Parse faults, and check them against the home.

    Raises:
        InputError: for the first that is wrong.
    """
    faults = tuple(parse_fault(text) for text in texts)
    for fault in faults:
        try:
            fault.check(home)
        except ValueError as error:
            raise InputError(f"--fault {fault}", str(error)) from None
    return faults


def refuse_physical(faults: Iterable[Fault]) -> None:
    """Check that the instant world can apply all faults.

    Raises:
        InputError: for the first that needs the physics world.
    """
    for fault in faults:
        if fault.physical:
            raise InputError(f"--fault {fault}", "this needs --world physics")


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{text!r} is no number")
    return number


def _up_to_one(value: str, what: str) -> float:
    number = _number(value)
    if not 0 < number <= 1:
        raise ValueError(f"should be {what}: more than 0, at most 1")
    return number


def _of(names: Iterable[str]) -> str:
    return ", ".join(names)
