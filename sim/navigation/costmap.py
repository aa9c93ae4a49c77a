"""Obstacles that are not on the map: seen by the laser or bumped into.

This is the local costmap of common navigation stacks: a scan marks the cells that it hits, and
clears those that it sees through; the planner treats marked cells as obstacles.
"""

import numpy as np
from scipy.spatial import KDTree

from executive.geometry import Floats
from sim.body.laser import Scan
from sim.navigation.grid import FOOTPRINT_M, OccupancyGrid

CELL_M = 0.05
KNOWN_M = 0.10
"""A hit this near to an obstacle of the map belongs to that obstacle, and is not marked."""
THICKNESS_M = 0.15
"""A mark is cleared if the laser sees this much farther than the mark in its direction."""
FORGOTTEN_S = 60.0
"""`forget` drops marks that were not seen for this long: the obstacle may be gone."""
TOO_NEAR_M = FOOTPRINT_M + 0.02
"""A path that comes nearer than this to a mark is blocked."""
Cell = tuple[int, int]
"""x and y in `map`, in units of CELL_M."""


class Costmap:
    """The map, and marked obstacles that are not on it."""

    def __init__(self, grid: OccupancyGrid) -> None:
        """Begin with the map and no marks."""
        self._grid = grid
        self._seen: dict[Cell, float] = {}
        self._bumps: dict[Cell, float] = {}

    def take(self, scan: Scan, time_s: float) -> None:
        """Clear the marks that the scan sees through, and mark its hits; `time_s` is now."""
        marks = _points(self._seen)
        if len(marks):
            away = np.linalg.norm(marks - scan.middle, axis=1)
            through = scan.free_to(marks) - THICKNESS_M > away
            kept = zip(self._seen.items(), through, strict=True)
            self._seen = {cell: seen for (cell, seen), gone in kept if not gone}
        hits = scan.hits()
        new = hits[self._grid.clearance_at(hits) > KNOWN_M]
        self._seen.update(dict.fromkeys(_cells(new), time_s))

    def bump(self, point: Floats, time_s: float) -> None:
        """Mark a point (2,) in `map` where the robot hit something that the laser does not see."""
        self._bumps.update(dict.fromkeys(_cells(point[None]), time_s))

    def forget(self, time_s: float) -> None:
        """Drop the marks that were not seen for FORGOTTEN_S."""
        for marks in (self._seen, self._bumps):
            for cell in [c for c, seen in marks.items() if time_s - seen > FORGOTTEN_S]:
                del marks[cell]

    @property
    def is_empty(self) -> bool:
        """Whether nothing is marked."""
        return not (self._seen or self._bumps)

    def blocks(self, way: Floats, here: Floats) -> bool:
        """Whether the robot would come too near to a mark.

        A robot that is already too near may drive on, as long as it comes no nearer.

        Args:
            way: the points (n, 2) that it is about to pass (metres, in `map`).
            here: (2,) its position now.
        """
        if self.is_empty:
            return False
        marks = KDTree(self._marks())
        limit = min(TOO_NEAR_M, float(marks.query(here)[0]) - CELL_M / 2)
        return bool(np.min(marks.query(way)[0]) < limit)

    def grid(self) -> OccupancyGrid:
        """The map with the marks as obstacles."""
        return self._grid if self.is_empty else self._grid.with_obstacles(self._marks())

    def _marks(self) -> Floats:
        return _points({**self._seen, **self._bumps})


def _points(cells: dict[Cell, float]) -> Floats:
    return np.array(list(cells), dtype=np.float64).reshape(-1, 2) * CELL_M


def _cells(points: Floats) -> list[Cell]:
    return [(int(x), int(y)) for x, y in np.rint(points / CELL_M)]
