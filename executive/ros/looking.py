"""Where a robot looks: what a goal of looking consists of, and whether it faces what it should."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from executive.geometry import transform
from executive.ros.link import LinkError
from executive.ros.messages import point_stamped
from executive.ros.profile import Profile
from executive.ros.senses import Senses
from executive.types.geometry import Pose, Vector3
from executive.types.home import FLOOR

FLOOR_PANS = (0.0, 1.0, -1.0, 2.0, -2.0)
"""Where the robot looks for what fell: to the left of where it faces (radians)."""
FLOOR_AHEAD_M = 0.9


class Looking:
    """Belongs to the thread of the wire; `views` is for any."""

    def __init__(
        self,
        profile: Profile,
        senses: Senses,
        view_targets: Callable[[str], tuple[Vector3, ...]],
    ) -> None:
        """`view_targets` tells which points of `map` one looks at, to see all of a place."""
        self._look = profile.look
        self._frames = profile.frames
        self._senses = senses
        self._view_targets = view_targets

    def views(self, place: str) -> int:
        """How many looks it takes to see all of a place."""
        if self._look is None:
            return 1
        if place == FLOOR:
            return len(FLOOR_PANS) if self._look.views is None else 1
        return self._look.views or len(self._view_targets(place))

    def target(self, place: str, view: int) -> Vector3:
        """The point of `map` to look at; more views than there are points look there again."""
        targets = self._targets(place)
        return targets[view % len(targets)]

    def _targets(self, place: str) -> Sequence[Vector3]:
        """To see all of a place."""
        if place != FLOOR:
            return self._view_targets(place)
        base = self._senses.base or Pose()
        x, y, _ = base.position
        yaw = _yaw(base)
        return [
            (x + FLOOR_AHEAD_M * math.cos(yaw + pan), y + FLOOR_AHEAD_M * math.sin(yaw + pan), 0.0)
            for pan in FLOOR_PANS
        ]

    def goal(self, place: str, target: Vector3) -> dict[str, Any]:
        """What a goal of looking may consist of.

        Raises:
            LinkError: if it takes a frame that nobody tells.
        """
        look, frames = self._look, self._frames
        values: dict[str, Any] = {
            "place": place,
            "point": point_stamped(target, frames.map),
            "camera": frames.camera,
            "turn": self._turn(target),
        }
        if look is not None and look.joints is not None:
            mount = self._senses.frames.pose(frames.map, look.mount)
            if mount is None:
                raise LinkError(f"nobody tells where {look.mount} is in {frames.map}")
            x, y, z = _moved(mount, target)
            angles = [math.atan2(y, x), math.atan2(-z, math.hypot(x, y))]
            values |= {"joints": list(look.joints), "angles": angles}
        return values

    def away(self, target: Vector3) -> float:
        """How far the camera, or the base if that turns, is turned away from a point (radians).

        0 if nobody tells.
        """
        look, frames = self._look, self._frames
        if look is None or look.joints is None or not frames.camera:
            return abs(self._turn(target))
        eye = self._senses.frames.pose(frames.map, frames.camera)
        if eye is None:
            return 0.0
        x, y, z = _moved(eye, target)
        return math.atan2(math.hypot(x, y), z)

    def _turn(self, target: Vector3) -> float:
        """How far to turn to the left to face a point (radians); 0 if nobody tells where I am."""
        base = self._senses.base
        if base is None:
            return 0.0
        x, y, _ = base.position
        return math.remainder(math.atan2(target[1] - y, target[0] - x) - _yaw(base), math.tau)


def _moved(pose: Pose, point: Vector3) -> Vector3:
    """A point from the child frame of a pose to its parent frame."""
    x, y, z = (float(one) for one in transform(pose, np.array([point]))[0])
    return x, y, z


def _yaw(pose: Pose) -> float:
    x, y, z, w = pose.orientation
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
