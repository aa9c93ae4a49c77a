"""What the simulated robot can be told beside the goals that the executive has: no places."""

from dataclasses import dataclass

from executive.types import Vector3


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
