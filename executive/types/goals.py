"""Goals that the robot can pursue."""

from dataclasses import dataclass

from executive.types.geometry import Vector3
from executive.types.perception import Detection


@dataclass(frozen=True, slots=True)
class DriveTo:
    """Drive to a piece of furniture, to `person` or to `delivery`, and stand in front of it."""

    place: str


@dataclass(frozen=True, slots=True)
class LookAt:
    """Point the camera at a piece of furniture, at `delivery` or at the `floor`.

    Attributes:
        view: number of the head pose, from 0 to `Robot.views(place) - 1`.
        point: if given, the point of `map` (metres) to bring to the middle of the picture, instead
            of `view`.
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
    """Put the held thing down on a free spot of this place."""

    place: str


@dataclass(frozen=True, slots=True)
class Halt:
    """Stop all motion; a held thing stays held."""


Goal = DriveTo | LookAt | Pick | PutDown | Halt
