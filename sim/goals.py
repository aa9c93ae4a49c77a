"""What the simulated robot can be told beside the goals that the executive has: no places."""

from collections.abc import Mapping
from dataclasses import dataclass

from executive.records import Shape
from executive.types.geometry import Pose, Vector3
from executive.types.goals import Goal

NO_MOTION = "there is no free way for my arm"
UNREACHABLE = "my arm does not reach there"
"""Why a hand or joints are not brought to somewhere."""


@dataclass(frozen=True, slots=True)
class GoTo:
    """Drive to a pose in `map` (metres, radians), whatever stands there."""

    x: float
    y: float
    yaw: float


@dataclass(frozen=True, slots=True)
class Face:
    """Point the head at a point of `map` (metres), wherever the robot is."""

    point: Vector3


@dataclass(frozen=True, slots=True)
class MoveHand:
    """Bring the point between the fingers to a pose in `base_link`.

    Attributes:
        pose: z points out of the hand, y to a finger.
        speed: share of the joints' speed limits.
        straight: in a straight line, or not at all.
        load: what is in the hand and has to be kept clear of things, as the hand sees it.
    """

    pose: Pose
    speed: float
    straight: bool = False
    load: tuple[Shape, ...] = ()


@dataclass(frozen=True, slots=True)
class MoveJoints:
    """Bring joints of lift and arm to positions (metres, radians); the rest as above."""

    joints: Mapping[str, float]
    speed: float
    load: tuple[Shape, ...] = ()


@dataclass(frozen=True, slots=True)
class Grip:
    """Move the fingers to a gap (metres); what is between them is pressed so hard (newtons)."""

    gap: float
    force: float


AnyGoal = Goal | GoTo | Face | MoveHand | MoveJoints | Grip
"""All that it can be told."""
