"""Drives the omnidirectional base along a path, with bounded speed and acceleration."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from executive.geometry import Floats
from sim.body.hardware import Hardware
from sim.body.skill import CONTROL_S, CannotError, Skill
from sim.body.way import Way

BRAKING = 2.0
TURN_BRAKING = 4.0
"""Decelerations for unplanned stops (m/s2, rad/s2)."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of the base's velocity and acceleration (m/s, m/s2, rad/s, rad/s2)."""

    speed: float
    acceleration: float
    turn_rate: float
    turn_acceleration: float


FREE = Limits(0.8, 0.8, 1.2, 2.0)
CARRYING = Limits(0.5, 0.5, 0.8, 1.2)
"""With an object in the hand."""
CREEPING = Limits(0.35, 0.5, 0.8, 1.2)
"""While the arm is extended, or near furniture."""

RADIUS_M = 0.31
"""Radius of the base."""
NEAR = 0.008
NEAR_ANGLE = np.radians(0.8)
"""Goal tolerance (metres, radians)."""
_LOOKAHEAD_S = 0.2
_SHORTEST_LOOKAHEAD = 0.08
_NEXT_BIT = np.arange(0.0, 0.3, 0.01)
"""Path lengths ahead (metres) at which the path point nearest to the robot is searched for."""
_FACE_TRAVEL_BEYOND = 0.9
"""Farther than this from the end (metres), the robot faces its direction of travel."""
_OFF_THE_WAY_M = 0.03
"""How far the base may leave the path in a corner (metres)."""
_CORNER_M = 0.12
"""The speed limit of a corner applies this far before and after it (metres)."""
_CHECKED_M = 0.1
"""Distance between the path points that are checked for obstacles."""
_STUCK_S = 1.5
_STUCK_DISTANCE, _STUCK_ANGLE = 0.02, 0.03
"""The robot is stuck if it makes less progress than this (metres, radians) in `_STUCK_S`."""


class BlockedError(CannotError):
    """An obstacle blocks the path.

    Attributes:
        bump: (2,) the point of contact in `map` (metres), if the robot has hit the obstacle; None
            if it has only seen it.
    """

    def __init__(self, bump: Floats | None = None) -> None:
        """The obstacle was hit at `bump`, or only seen."""
        super().__init__("the way is blocked")
        self.bump = bump


def drive(
    hardware: Hardware,
    path: Sequence[tuple[float, float]],
    yaw: float,
    limits: Limits = FREE,
    blocked: Callable[[Callable[[], Floats]], bool] = lambda ahead: False,
) -> Skill:
    """Follow way-points and park at the last one, facing `yaw`.

    Args:
        hardware: the robot.
        path: the way-points (metres, in `map`).
        yaw: final heading (radians, in `map`).
        limits: limits of velocity and acceleration.
        blocked: called once per control period; if it returns True, the robot brakes. Its argument
            is a function that returns the points (n, 2) of the remaining path (metres, in `map`).

    Raises:
        BlockedError: if `blocked` says so, or the robot makes no progress.
    """
    follower = _Follower(np.array([hardware.base_pose[:2], *path]), yaw, limits)
    progress, state = _Progress(), hardware.base_state
    while not follower.arrived(*state):
        velocity = follower.velocity(state[0])
        hardware.command_base(velocity)
        yield
        if blocked(follower.ahead):
            yield from brake(hardware)
            raise BlockedError
        state = hardware.base_state
        if progress.stuck(*follower.left(state[0])):
            bump = _rim(state[0], velocity)
            yield from brake(hardware)
            raise BlockedError(bump)
    hardware.park()


def fastest(points: Floats, along: Floats, limits: Limits) -> Floats:
    """The speed profile (n,) of a path that is followed from rest to rest (m/s).

    Args:
        points: (m, 2) the way-points (metres).
        along: (n,) path lengths from the start at which the speeds are wanted (metres).
        limits: limits of velocity and acceleration.
    """
    ends = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    most = np.full(len(along), limits.speed)
    for corner, speed in zip(ends[1:-1], _corner_speeds(points, limits.acceleration), strict=True):
        near = np.abs(along - corner) < _CORNER_M
        most[near] = np.minimum(most[near], speed)
    left = np.maximum(ends[-1] - along, 0.0)
    most = np.minimum(most, np.minimum(0.9 * np.sqrt(2 * limits.acceleration * left), 4.0 * left))
    squares = np.minimum.accumulate(
        np.concatenate(([0.0], most[1:] ** 2)) - 2 * limits.acceleration * along
    )
    faster = squares + 2 * limits.acceleration * along
    braking = 1.6 * limits.acceleration * along
    slower = np.minimum.accumulate((faster + braking)[::-1])[::-1] - braking
    speeds: Floats = np.sqrt(np.maximum(slower, 0.0))
    return speeds


def brake(hardware: Hardware) -> Skill:
    """Bring the base to rest and park it."""
    velocity = hardware.base_velocity
    while np.abs(velocity).max() > 1e-3:
        velocity = _toward(velocity, np.zeros(3), BRAKING, TURN_BRAKING)
        hardware.command_base(velocity)
        yield
    hardware.park()


def _rim(pose: Floats, velocity: Floats) -> Floats:
    """The foremost point (2,) of the base's rim in its direction of travel (metres, in `map`)."""
    speed = max(float(np.linalg.norm(velocity[:2])), 1e-6)
    rim: Floats = pose[:2] + RADIUS_M * velocity[:2] / speed
    return rim


class _Progress:
    """Detects that the robot is stuck: the remaining path gets no shorter, and it does not turn."""

    def __init__(self) -> None:
        self._way, self._turn, self._since = np.inf, 0.0, 0.0

    def stuck(self, way: float, turn: float) -> bool:
        """Whether there was no progress for `_STUCK_S`; called once per control period.

        Args:
            way: length of the remaining path (metres).
            turn: remaining turn (radians).
        """
        self._since += CONTROL_S
        if way < self._way - _STUCK_DISTANCE:
            self._way, self._since = way, 0.0
        if abs(turn - self._turn) > _STUCK_ANGLE:
            self._turn, self._since = turn, 0.0
        return self._since > _STUCK_S


class _Follower:
    """Pure pursuit: drives toward a look-ahead point on the path."""

    def __init__(self, points: Floats, yaw: float, limits: Limits) -> None:
        self._points = points
        self._yaw = yaw
        self._limits = limits
        self._lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
        self._ends = np.concatenate(([0.0], np.cumsum(self._lengths)))
        self._end = float(self._ends[-1])
        self._way = Way(self._ends, points)
        self._corner_speeds = _corner_speeds(points, limits.acceleration)
        self._done = 0.0
        self._command = np.zeros(3)

    def arrived(self, pose: Floats, velocity: Floats) -> bool:
        """Whether the base is at rest at the goal, within its tolerance."""
        off = _length(pose[:2] - self._points[-1])
        still = np.abs(velocity).max() < 0.03
        return bool(still and off < NEAR and abs(_turn(pose[2], self._yaw)) < NEAR_ANGLE)

    def left(self, pose: Floats) -> tuple[float, float]:
        """The length of the remaining path (metres) and the angle to the final yaw (radians)."""
        way = self._end - self._done + _length(self._way.at(self._done) - pose[:2])
        return way, abs(_turn(pose[2], self._yaw))

    def ahead(self) -> Floats:
        """Points (n, 2) of the remaining path, _CHECKED_M apart (metres, in `map`)."""
        lengths = np.append(np.arange(self._done, self._end, _CHECKED_M), self._end)
        return self._way.at_each(lengths)

    def velocity(self, pose: Floats) -> Floats:
        """The next velocity command (3,) in `map` (m/s, m/s, rad/s) at a pose (x, y, yaw)."""
        self._advance(pose[:2])
        ahead = max(_SHORTEST_LOOKAHEAD, _LOOKAHEAD_S * _length(self._command[:2]))
        toward = self._way.at(self._done + ahead) - pose[:2]
        distance = _length(toward)
        left = self._end - self._done
        if left < ahead:
            left = distance
        limits, wanted = self._limits, np.zeros(3)
        if distance > 1e-6:
            fastest = min(limits.speed, self._before_corners())
            wanted[:2] = toward / distance * _slowing(left, fastest, limits.acceleration)
        turn = _turn(pose[2], self._heading(toward, left))
        wanted[2] = np.sign(turn) * _slowing(abs(turn), limits.turn_rate, limits.turn_acceleration)
        self._command = _toward(
            self._command, wanted, limits.acceleration, limits.turn_acceleration
        )
        return self._command

    def _before_corners(self) -> float:
        """The speed (m/s) from which the base can still slow down for all corners ahead."""
        ways = self._ends[1:-1] - self._done
        near = ways > -_CORNER_M
        ways = (ways[near] - _CORNER_M).clip(min=0.0)
        squares = self._corner_speeds[near] ** 2 + 1.6 * self._limits.acceleration * ways
        return float(np.sqrt(squares.min(initial=np.inf)))

    def _heading(self, toward: Floats, left: float) -> float:
        if left > _FACE_TRAVEL_BEYOND:
            return float(np.arctan2(toward[1], toward[0]))
        return self._yaw

    def _advance(self, position: Floats) -> None:
        """Advance `_done` to the nearest point of the next part of the path."""
        ahead = np.minimum(self._done + _NEXT_BIT, self._end)
        off = self._way.at_each(ahead) - position
        self._done = float(ahead[np.sqrt((off * off).sum(axis=1)).argmin()])


def _corner_speeds(points: Floats, acceleration: float) -> Floats:
    """The speed (m/s) at each corner for which the base stays within `_OFF_THE_WAY_M`."""
    ways = np.diff(points, axis=0)
    headings = np.arctan2(ways[:, 1], ways[:, 0])
    turns = np.abs(np.remainder(np.diff(headings) + np.pi, 2 * np.pi) - np.pi)
    sharpness = np.sin(turns / 2).clip(min=1e-3)
    speeds: Floats = np.sqrt(2 * acceleration * _OFF_THE_WAY_M) / sharpness
    return speeds


def _slowing(distance: float, fastest: float, deceleration: float) -> float:
    """The speed from which one can still stop within a distance; lower close to the end."""
    return min(fastest, 0.9 * math.sqrt(2 * deceleration * distance), 4.0 * distance)


def _toward(now: Floats, wanted: Floats, acceleration: float, turn_acceleration: float) -> Floats:
    """The wanted velocity, or the nearest one that can be reached in one control period."""
    change = wanted - now
    size = _length(change[:2])
    if size > acceleration * CONTROL_S:
        change[:2] *= acceleration * CONTROL_S / size
    most = turn_acceleration * CONTROL_S
    change[2] = min(max(change[2], -most), most)
    next_velocity: Floats = now + change
    return next_velocity


def _turn(start: float, end: float) -> float:
    """The signed angle from one yaw to another, in [-pi, pi) (radians)."""
    return float((end - start + math.pi) % math.tau - math.pi)


def _length(vector: Floats) -> float:
    """The same as `np.linalg.norm`, bit for bit, but faster for short vectors."""
    return math.sqrt(vector.dot(vector))
