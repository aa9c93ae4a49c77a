"""What stands in the way and is not on the map: seen by the laser or bumped into, until it is gone.

The local costmap of the field's navigation stacks: scans mark what they hit and clear what they
see through; the planner takes the marks for obstacles.
"""

import numpy as np
from scipy.spatial import KDTree

from executive.geometry import Floats
from sim.body.laser import Scan
from sim.navigation.grid import FOOTPRINT_M, OccupancyGrid

CELL_M = 0.05
KNOWN_M = 0.10
"""What is hit this near to something on the map is that."""
THICKNESS_M = 0.15
"""A mark is cleared if the laser sees this much farther in its direction."""
FORGOTTEN_S = 60.0
"""Marks that were not seen again for so long may be gone: it is worth a look."""
TOO_NEAR_M = FOOTPRINT_M + 0.02
"""A way that comes this near to a mark is blocked."""
Cell = tuple[int, int]


class Costmap:
    """The marks, and the map with them."""

    def __init__(self, grid: OccupancyGrid) -> None:
        """Know only the map."""
        self._grid = grid
        self._seen: dict[Cell, float] = {}
        self._bumps: dict[Cell, float] = {}

    def take(self, scan: Scan, time_s: float) -> None:
        """Clear what the scan sees through, mark what it hits."""
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
        """Mark a point (2,) in `map` where the robot met something that the laser does not see."""
        self._bumps.update(dict.fromkeys(_cells(point[None]), time_s))

    def forget(self, time_s: float) -> None:
        """Drop the marks of long ago."""
        for marks in (self._seen, self._bumps):
            for cell in [c for c, seen in marks.items() if time_s - seen > FORGOTTEN_S]:
                del marks[cell]

    @property
    def is_empty(self) -> bool:
        """Whether nothing is marked."""
        return not (self._seen or self._bumps)

    def blocks(self, way: Floats, here: Floats) -> bool:
        """Whether the robot, now at `here` (2,), would come too near to a mark.

        `way` are the points (n, 2) that it means to pass. Out of a tight spot it may go, as long as
        that takes it no nearer.
        """
        if self.is_empty:
            return False
        marks = KDTree(self._marks())
        limit = min(TOO_NEAR_M, float(marks.query(here)[0]) - CELL_M / 2)
        return bool(np.min(marks.query(way)[0]) < limit)

    def grid(self) -> OccupancyGrid:
        """The map with what is marked in the way."""
        return self._grid if self.is_empty else self._grid.with_obstacles(self._marks())

    def _marks(self) -> Floats:
        return _points({**self._seen, **self._bumps})


def _points(cells: dict[Cell, float]) -> Floats:
    return np.array(list(cells), dtype=np.float64).reshape(-1, 2) * CELL_M


def _cells(points: Floats) -> list[Cell]:
    return [(int(x), int(y)) for x, y in np.rint(points / CELL_M)]
