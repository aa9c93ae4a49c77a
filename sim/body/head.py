"""Aims the head's camera."""

import math

from executive.types.geometry import Vector3
from sim.body.hardware import Hardware
from sim.body.skill import CannotError, Skill, wait_until

_SETTLED = 0.005
_AT_MOST_S = 4.0


def look_at(hardware: Hardware, target: Vector3) -> Skill:
    """Turn the head until a point in `map` is in the centre of the picture.

    Raises:
        CannotError: if the head does not reach the angles in time.
    """
    pan, tilt = aim(hardware, target)
    hardware.command_head(pan, tilt)

    def aimed() -> bool:
        now = hardware.head_positions
        return bool(abs(now[0] - pan) < _SETTLED and abs(now[1] - tilt) < _SETTLED)

    if not (yield from wait_until(aimed, _AT_MOST_S)):
        raise CannotError("I cannot turn my head that far")


def hold_head(hardware: Hardware) -> None:
    """Hold the head at its current angles."""
    pan, tilt = (float(value) for value in hardware.head_positions)
    hardware.command_head(pan, tilt)


def aim(hardware: Hardware, target: Vector3) -> tuple[float, float]:
    """Pan and tilt (radians) that bring a point in `map` to the centre of the picture."""
    x, y, z = hardware.link_pose("camera_link").position
    ahead, left = target[0] - x, target[1] - y
    pan = math.remainder(math.atan2(left, ahead) - float(hardware.base_pose[2]), math.tau)
    return pan, math.atan2(z - target[2], math.hypot(ahead, left))
