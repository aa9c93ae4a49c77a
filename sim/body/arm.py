"""Moving the lift and the arm along a path of joint positions, smoothly and within their limits."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats
from sim.body.hardware import ARM, Hardware
from sim.body.skill import CONTROL_S, CannotError, Skill, wait_until
from sim.body.way import Way

SPEED = 0.6
"""Share of the joints' speed limits that a motion uses."""
SLOW = 0.15
_RAMP_S = 0.3
_LAG = 0.2
"""A joint this far behind (radians, metres) has met something."""
_OFF = 0.05
"""A joint that comes to rest this far off did not arrive (radians, metres)."""
_SAME_WAY = 0.9
"""Cosine between successive directions in joint space that are passed without stopping."""
_SETTLED = 0.004
_SETTLING_S = 1.0


def follow(
    hardware: Hardware,
    path: Sequence[Floats],
    speed: float = SPEED,
    until: Callable[[], bool] = lambda: False,
) -> Skill:
    """Move through joint positions (of `ARM`), starting from where the arm is.

    Args:
        hardware: the robot.
        path: the positions to pass; the last is where the arm comes to rest.
        speed: share of the joints' speed limits.
        until: asked once per control period whether to stop where the arm is.

    Raises:
        CannotError: if a joint cannot follow.
    """
    points = np.array([hardware.arm_positions, *path])
    durations = (np.abs(np.diff(points, axis=0)) / (speed * hardware.arm_speed_limits)).max(axis=1)
    times = np.concatenate(([0.0], np.cumsum(durations)))
    stops, way = times[_corners(points)], Way(times, points)
    reached, rate = 0.0, 0.0
    before = points[0]
    while reached < times[-1]:
        next_stop = stops[np.searchsorted(stops, reached, side="right")]
        rate = min(1.0, rate + CONTROL_S / _RAMP_S, _slowing(next_stop - reached))
        reached = min(times[-1], reached + rate * CONTROL_S)
        now = way.at(reached)
        hardware.command_arm(now, (now - before) / CONTROL_S)
        before = now
        yield
        if until():
            hold(hardware)
            return
        _check_lag(hardware, now, _LAG)
    hardware.command_arm(before, np.zeros(len(before)))
    yield from wait_until(
        lambda: bool(np.abs(hardware.arm_positions - before).max() < _SETTLED), _SETTLING_S
    )
    _check_lag(hardware, before, _OFF)


def _check_lag(hardware: Hardware, wanted: Floats, most: float) -> None:
    """Give up if a joint is farther than `most` from where it should be."""
    lag = np.abs(hardware.arm_positions - wanted)
    if lag.max() > most:
        hold(hardware)
        joint = ARM[int(lag.argmax())].removeprefix("panda_")
        raise CannotError(f"my arm does not follow: {joint} is stuck, or something is in its way")


def hold(hardware: Hardware) -> None:
    """Stay where the arm is now."""
    positions = hardware.arm_positions
    hardware.command_arm(positions, np.zeros(len(positions)))


def _corners(points: Floats) -> NDArray[np.bool_]:
    """Which points, the last included, the joints must come to rest at: where they turn sharply."""
    ways = np.diff(points, axis=0)
    ways /= np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-9)
    straight = (ways[:-1] * ways[1:]).sum(axis=1) > _SAME_WAY
    return np.concatenate(([False], ~straight, [True]))


def _slowing(left: float) -> float:
    """The rate from which the end of a motion is met at rest."""
    return float(max(0.05, np.sqrt(2 * left / _RAMP_S) * 0.7))
