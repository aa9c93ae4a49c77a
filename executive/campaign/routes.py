"""Shortest paths of the robot in the map of a home."""

from collections.abc import Iterable
from functools import cache, cached_property
from itertools import pairwise
from math import dist, inf

import numpy as np

from executive.geometry import Floats
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.navigation.grid import OccupancyGrid, Point, Reach, Unreachable


class Lengths(OccupancyGrid):
    """A grid where narrow passages cost nothing extra: the cheapest path is the shortest."""

    @cached_property
    def price(self) -> Floats:
        """(columns, rows) 1 where the robot can be, else infinite."""
        return np.where(self.free, 1.0, np.inf)


class Routes:
    """Shortest paths in a home."""

    def __init__(self, home: Home) -> None:
        """Compute the occupancy grid."""
        self._home = home
        self._grid = Lengths.from_home(home)
        self._known: dict[tuple[Point, Point], float] = {}
        self._reach: tuple[Point, Reach | None] | None = None

    def stand(self, place: str) -> Point:
        """Position in `map` where the robot stands at a piece of furniture, or at the `person`."""
        x, y, _ = self._home.stand(place)
        return x, y

    def length(self, start: Point, goal: Point) -> float:
        """Length of the shortest path (metres); infinite if there is none."""
        if (start, goal) not in self._known:
            self._known[start, goal] = self._measure(start, goal)
        return self._known[start, goal]

    def nearest(self, start: Point, places: Iterable[str]) -> str:
        """The furniture with the shortest path from here; of equals the first.

        No path is shorter than the straight line, so farther places are not measured.
        """
        by_line = sorted(
            (dist(start, self.stand(place)), number, place) for number, place in enumerate(places)
        )
        best = inf, inf, by_line[0][2]
        for line, number, place in by_line:
            if line > best[0]:
                break
            best = min(best, (self.length(start, self.stand(place)), number, place))
        return best[2]

    def tour(self, points: tuple[Point, ...]) -> float:
        """Length of the shortest path through these points, in order (metres)."""
        return sum(self.length(a, b) for a, b in pairwise(points))

    def _measure(self, start: Point, goal: Point) -> float:
        reach = self._reach_from(start)
        way = reach.way(goal) if reach else None
        return sum(dist(a, b) for a, b in pairwise(way)) if way else inf

    def _reach_from(self, start: Point) -> Reach | None:
        """All that is reachable from here; only the last result is cached, since each is large."""
        if self._reach is None or self._reach[0] != start:
            try:
                self._reach = start, Reach.of(self._grid, start)
            except Unreachable:
                self._reach = start, None
        return self._reach[1]


@cache
def routes_in(home: str) -> Routes:
    """The routes of a home, by its name or file; cached."""
    return Routes(load_home(home))


def routes_of(home: Home) -> Routes:
    """The routes of this home, wherever its things are; cached."""
    key = home.model_dump_json(exclude={"objects"})
    if key not in _cached:
        _cached[key] = Routes(home)
    return _cached[key]


_cached: dict[str, Routes] = {}
