"""Estimates how long the robot drives between places, from the map alone.

The estimate follows the speed profile of `sim.body.base`, with its limits at corners and ends, and
adds the turn to face the place at the end.
"""

import threading

import numpy as np

from executive.geometry import Floats
from executive.types.home import DELIVERY, PERSON
from sim.body.base import FREE, Limits, fastest
from sim.home.furniture import PlanarPose
from sim.home.home import Home
from sim.navigation.grid import OccupancyGrid, Point, ways

STEP_M = 0.02
"""Distance between the path points at which speeds are computed."""
TURNING_M = 0.9
"""The robot begins to turn to the place this far before the end."""


class Durations:
    """The driving times between all places of a home, computed on demand; safe for threads."""

    def __init__(self, home: Home, grid: OccupancyGrid) -> None:
        """Compute nothing yet."""
        self._home = home
        self._grid = grid
        self._known: dict[str, dict[str, float]] = {}
        self._lock = threading.Lock()

    def seconds(self, start: str, place: str) -> float:
        """The driving time from a place to another (s); infinite if unreachable or unknown."""
        with self._lock:
            if start not in self._known:
                self._known[start] = self._from(start)
            return self._known[start].get(place, np.inf)

    def work_out(self) -> None:
        """Compute all driving times ahead of time."""
        for place in self._places():
            self.seconds(place, place)

    def _places(self) -> tuple[str, ...]:
        return (PERSON, DELIVERY, *(piece.name for piece in self._home.furniture))

    def _stand(self, place: str) -> PlanarPose:
        return self._home.stand(self._home.delivery.name if place == DELIVERY else place)

    def _from(self, start: str) -> dict[str, float]:
        places = self._places()
        if start not in places:
            return {}
        stands = {place: self._stand(place) for place in places}
        goals: list[Point] = [stand[:2] for stand in stands.values()]
        found = ways(self._grid, stands[start][:2], goals)
        return {
            place: np.inf if way is None else duration(way, stands[start][2], stands[place][2])
            for place, way in zip(places, found, strict=True)
        }


def durations_in(home: Home, grid: OccupancyGrid) -> Durations:
    """The driving times in a home; shared by all homes that differ only in their objects.

    They are computed once per process, on a thread of their own.
    """
    key = home.model_dump_json(exclude={"objects"})
    if key not in _worked_out:
        _worked_out[key] = durations = Durations(home, grid)
        threading.Thread(target=durations.work_out, name="ways", daemon=True).start()
    return _worked_out[key]


_worked_out: dict[str, Durations] = {}


def duration(way: tuple[Point, ...], yaw: float, end_yaw: float, limits: Limits = FREE) -> float:
    """The driving time along a path, from rest to rest (s).

    Args:
        way: the way-points (metres, in `map`).
        yaw: heading at the start (radians).
        end_yaw: heading at the end (radians).
        limits: limits of velocity and acceleration.
    """
    points = np.array(way)
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    length = float(lengths.sum())
    if length < STEP_M:
        return _turning(abs(float(np.remainder(end_yaw - yaw + np.pi, 2 * np.pi) - np.pi)), limits)
    along = np.linspace(0.0, length, max(3, int(length / STEP_M)))
    speeds = fastest(points, along, limits)
    times = 2 * np.diff(along) / np.maximum(speeds[1:] + speeds[:-1], 1e-3)
    return float(times.sum()) + _late_turn(points, along, times, end_yaw, limits)


def _late_turn(
    points: Floats, along: Floats, times: Floats, end_yaw: float, limits: Limits
) -> float:
    """The time that the final turn still takes after the end of the path is reached (s)."""
    last = points[-1] - points[-2]
    turn = float(np.remainder(end_yaw - np.arctan2(last[1], last[0]) + np.pi, 2 * np.pi) - np.pi)
    left = float(times[along[:-1] > along[-1] - TURNING_M].sum())
    return max(0.0, _turning(abs(turn), limits) - left)


def _turning(angle: float, limits: Limits) -> float:
    """The time for a turn on the spot by an angle in radians (s)."""
    slowly = limits.turn_rate**2 / limits.turn_acceleration
    if angle < slowly:
        return 2 * float(np.sqrt(angle / limits.turn_acceleration))
    return angle / limits.turn_rate + limits.turn_rate / limits.turn_acceleration
