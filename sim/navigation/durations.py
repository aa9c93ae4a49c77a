"""How long the robot's ways take, by the map: known before it sets out.

A way is driven as `sim.body.base` has it: no faster than corners, the distance to the end and the
acceleration allow, and with a turn to face the place at the end.
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
"""Speeds are worked out at points of the way that are so far apart."""
TURNING_M = 0.9
"""So far before the end the robot begins to turn to the place."""


class Durations:
    """The seconds of all ways between the places of a home; worked out when they are asked for."""

    def __init__(self, home: Home, grid: OccupancyGrid) -> None:
        """Know nothing yet."""
        self._home = home
        self._grid = grid
        self._known: dict[str, dict[str, float]] = {}
        self._lock = threading.Lock()

    def seconds(self, start: str, place: str) -> float:
        """Of the way from a place to another one; infinite if there is none, or no such place."""
        with self._lock:
            if start not in self._known:
                self._known[start] = self._from(start)
            return self._known[start].get(place, np.inf)

    def work_out(self) -> None:
        """All of them, ahead of time."""
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
    """Those of this home, wherever its things are; worked out once in a process, on a thread."""
    key = home.model_dump_json(exclude={"objects"})
    if key not in _worked_out:
        _worked_out[key] = durations = Durations(home, grid)
        threading.Thread(target=durations.work_out, name="ways", daemon=True).start()
    return _worked_out[key]


_worked_out: dict[str, Durations] = {}


def duration(way: tuple[Point, ...], yaw: float, end_yaw: float, limits: Limits = FREE) -> float:
    """Seconds of driving along a way (metres, in `map`), from standing at a yaw to another one."""
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
    """How much longer the turn at the end takes than the last bit of the way (s)."""
    last = points[-1] - points[-2]
    turn = float(np.remainder(end_yaw - np.arctan2(last[1], last[0]) + np.pi, 2 * np.pi) - np.pi)
    left = float(times[along[:-1] > along[-1] - TURNING_M].sum())
    return max(0.0, _turning(abs(turn), limits) - left)


def _turning(angle: float, limits: Limits) -> float:
    """Seconds of a turn (radians) on the spot."""
    slowly = limits.turn_rate**2 / limits.turn_acceleration
    if angle < slowly:
        return 2 * float(np.sqrt(angle / limits.turn_acceleration))
    return angle / limits.turn_rate + limits.turn_rate / limits.turn_acceleration
