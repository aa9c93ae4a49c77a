"""Moves the lift and the arm along a path of joint positions, smoothly and within their limits."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats
from sim.body.hardware import ARM, Hardware
from sim.body.skill import CONTROL_S, CannotError, Skill, wait_until
from sim.body.way import Way

SPEED = 0.6
"""Fraction of the joints' speed limits that a motion uses."""
SLOW = 0.15
"""The same for careful motions."""
_RAMP_S = 0.3
_LAG = 0.2
"""A joint that lags this far behind (radians, metres) has hit something, or is stuck."""
_OFF = 0.05
"""A joint that comes to rest this far from its goal has not reached it (radians, metres)."""
_SAME_WAY = 0.9
"""The arm passes a way-point without stopping if the cosine between the directions before and after
it, in joint space, is greater than this."""
_SETTLED = 0.004
_SETTLING_S = 1.0


def follow(
    hardware: Hardware,
    path: Sequence[Floats],
    speed: float = SPEED,
    until: Callable[[], bool] = lambda: False,
) -> Skill:
    """Move the joints of `ARM` along a path, starting from their current positions.

    Args:
        hardware: the robot.
        path: joint positions (8,) to pass; the arm comes to rest at the last.
        speed: fraction of the joints' speed limits.
        until: called once per control period; if it returns True, the arm stops where it is.

    Raises:
        CannotError: if a joint does not follow.
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
    """Stop the arm and raise CannotError if a joint is farther than `most` from its set point."""
    lag = np.abs(hardware.arm_positions - wanted)
    if lag.max() > most:
        hold(hardware)
        joint = ARM[int(lag.argmax())].removeprefix("panda_")
        raise CannotError(f"my arm does not follow: {joint} is stuck, or something is in its way")


def hold(hardware: Hardware) -> None:
    """Hold the arm at its current position."""
    positions = hardware.arm_positions
    hardware.command_arm(positions, np.zeros(len(positions)))


def _corners(points: Floats) -> NDArray[np.bool_]:
    """(n,) whether the arm must come to rest at each point: at sharp turns, and at the last."""
    ways = np.diff(points, axis=0)
    ways /= np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-9)
    straight = (ways[:-1] * ways[1:]).sum(axis=1) > _SAME_WAY
    return np.concatenate(([False], ~straight, [True]))


def _slowing(left: float) -> float:
    """The rate (fraction of full speed) from which one can stop in `left` seconds of the path."""
    return float(max(0.05, np.sqrt(2 * left / _RAMP_S) * 0.7))
