"""What the robot's body can be asked to do."""

from dataclasses import dataclass

from executive.types.geometry import Vector3
from executive.types.perception import Detection


@dataclass(frozen=True, slots=True)
class DriveTo:
    """Go and stand before a piece of furniture, `person` or `delivery`."""

    place: str


@dataclass(frozen=True, slots=True)
class LookAt:
    """Point the head at a place, `delivery` or the `floor`.

    `view` counts from 0 to `Robot.views(place) - 1`. With a `point` of `map` (metres) given, that
    is in the middle of the picture instead.
    """

    place: str
    view: int = 0
    point: Vector3 | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Pick:
    """Grasp the detected thing and lift it."""

    detection: Detection


@dataclass(frozen=True, slots=True)
class PutDown:
    """Place the held thing on a free spot of this place."""

    place: str


@dataclass(frozen=True, slots=True)
class Halt:
    """Come to rest, whatever is under way; a held thing stays held."""


Goal = DriveTo | LookAt | Pick | PutDown | Halt
