"""Goals of the simulated robot besides those of the executive: with poses instead of places."""

from collections.abc import Mapping
from dataclasses import dataclass

from executive.records import Shape
from executive.types.geometry import Pose, Vector3
from executive.types.goals import Goal

NO_MOTION = "there is no free way for my arm"
UNREACHABLE = "my arm does not reach there"
"""Reasons why a motion of the hand or of joints fails."""


@dataclass(frozen=True, slots=True)
class GoTo:
    """Drive to a pose in `map` (metres, radians), which need not belong to a place."""

    x: float
    y: float
    yaw: float


@dataclass(frozen=True, slots=True)
class Face:
    """Point the head at a point of `map` (metres)."""

    point: Vector3


@dataclass(frozen=True, slots=True)
class MoveHand:
    """Bring the point between the fingers to a pose in `base_link`.

    Attributes:
        pose: of the grasp frame; z points out of the hand, y to a finger.
        speed: fraction of the joints' speed limits.
        straight: whether the point must move in a straight line; the goal fails if it cannot.
        load: shapes of the held object in the grasp frame, for collision checks.
    """

    pose: Pose
    speed: float
    straight: bool = False
    load: tuple[Shape, ...] = ()


@dataclass(frozen=True, slots=True)
class MoveJoints:
    """Bring joints of lift and arm to positions (metres, radians), by name.

    `speed` and `load` are as in `MoveHand`.
    """

    joints: Mapping[str, float]
    speed: float
    load: tuple[Shape, ...] = ()


@dataclass(frozen=True, slots=True)
class Grip:
    """Move the fingers to a gap (metres); an object between them is pressed with `force` (N)."""

    gap: float
    force: float


AnyGoal = Goal | GoTo | Face | MoveHand | MoveJoints | Grip
"""All goals of the simulated robot."""
