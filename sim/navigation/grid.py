"""Ways for a round robot through the home: a grid of clearances, and the cheapest path on it.

The map is the home's plan, walls and furniture; what a person leaves on the floor is not in it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import KDTree

from executive.geometry import Floats
from sim.home.home import Home

Point = tuple[float, float]
Slices = tuple[slice, slice]

FOOTPRINT_M = 0.33
"""Radius of the robot, seen from above."""
COMFORT_M = 0.5
"""With this much room around its middle the robot is at ease; less costs extra."""
FAR_M = 1.0
"""What is farther away than this does not matter."""
DISCOMFORT = 4.0
"""How much dearer a metre is where the robot just fits."""
PERSON_RADIUS_M = 0.25
SLACK = 1.02
"""A straight line may cost this much of the path that it replaces."""
THINNED = 6
"""Where many ways are worked out, every so many-th cell of each is enough."""
SNAP_M = 0.25
"""The robot may start this far from where it is allowed to be, to get out of a tight place."""


class Unreachable(Exception):
    """There is no way; the text says why, as a clause with a gap for the name of the goal."""

    def clause(self, place: str) -> str:
        """Why there is none to this place: "the way to the desk is blocked"."""
        return str(self).format(place=place)


@dataclass(frozen=True, eq=False)
class OccupancyGrid:
    """How far each cell is from what stands in the way.

    Attributes:
        origin: the middle of cell [0, 0] in `map` (metres).
        resolution: side of a cell (metres).
        clearance: (columns, rows) distance from the middle of a cell, x by column and y by row, to
            the nearest wall, furniture or person (metres, at most FAR_M); 0 inside of them.
    """

    origin: Point
    resolution: float
    clearance: Floats

    @classmethod
    def from_home(cls, home: Home, resolution: float = 0.05) -> "OccupancyGrid":
        """The home as its plan has it; everything outside of the rooms is in the way."""
        edges = np.array([room.rectangle for room in home.rooms])
        origin = (float(edges[:, 0].min()), float(edges[:, 1].min()))
        steps = [
            round((edges[:, axis + 2].max() - origin[axis]) / resolution) + 1 for axis in (0, 1)
        ]
        x = origin[0] + np.arange(steps[0])[:, None] * resolution
        y = origin[1] + np.arange(steps[1])[None, :] * resolution
        inside = np.zeros(steps, bool)
        for a, b, c, d in edges.tolist():
            inside[np.ix_(((x >= a) & (x <= c)).ravel(), ((y >= b) & (y <= d)).ravel())] = True
        clearance = np.where(inside, FAR_M, 0.0)
        around = (*home.person[:2], 0.0, 2 * PERSON_RADIUS_M, 2 * PERSON_RADIUS_M)
        near = _window(origin, resolution, around)
        person = np.hypot(x[near[0]] - home.person[0], y[:, near[1]] - home.person[1])
        found = (person - PERSON_RADIUS_M).clip(min=0.0)
        clearance[near] = np.minimum(clearance[near], found)
        boxes = [(*wall.center, 0.0, *wall.size) for wall in home.walls()]
        boxes += [(*piece.pose, *piece.size[:2]) for piece in (*home.furniture, home.delivery)]
        for box in boxes:
            near = _window(origin, resolution, box)
            found = _distance_to_box(x[near[0]], y[:, near[1]], box)
            clearance[near] = np.minimum(clearance[near], found)
        return cls(origin, resolution, clearance)

    def with_obstacles(self, points: Floats) -> "OccupancyGrid":
        """The same with points (n, 2) of `map` in the way, too (metres)."""
        low, high = points.min(axis=0) - FAR_M, points.max(axis=0) + FAR_M
        first, last = (
            np.clip(self.cells(corner[None])[0], 0, self.clearance.shape) for corner in (low, high)
        )
        near = slice(first[0], last[0] + 1), slice(first[1], last[1] + 1)
        cells = np.indices(self.clearance[near].shape).reshape(2, -1).T + first
        found, _ = KDTree(points).query(self.origin + cells * self.resolution)
        clearance = self.clearance.copy()
        clearance[near] = np.minimum(clearance[near], np.reshape(found, clearance[near].shape))
        return OccupancyGrid(self.origin, self.resolution, clearance)

    def clearance_at(self, points: Floats) -> Floats:
        """(n,) clearance of the cells that points (n, 2) of `map` are in; 0 off the grid."""
        columns, rows = self.cells(points).T
        shape = self.clearance.shape
        on_grid = (columns >= 0) & (columns < shape[0]) & (rows >= 0) & (rows < shape[1])
        found = np.zeros(len(points))
        found[on_grid] = self.clearance[columns[on_grid], rows[on_grid]]
        return found

    def cells(self, points: Floats) -> NDArray[np.intp]:
        """(n, 2) column and row of the cells of points (n, 2); some may be off the grid."""
        return np.rint((points - self.origin) / self.resolution).astype(np.intp)

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """(columns, rows) whether the robot fits with its middle anywhere in the cell."""
        return np.asarray(self.clearance >= FOOTPRINT_M + self.resolution)

    def is_free(self, cell: tuple[int, int]) -> bool:
        """Whether a cell is on the grid and free."""
        columns, rows = self.free.shape
        return 0 <= cell[0] < columns and 0 <= cell[1] < rows and bool(self.free[cell])

    def cell(self, point: Point) -> tuple[int, int]:
        """Column and row of the cell that a point (metres, in `map`) is in; may be off the grid."""
        column, row = (
            round((value - start) / self.resolution)
            for value, start in zip(point, self.origin, strict=True)
        )
        return column, row

    def point(self, cell: tuple[int, int]) -> Point:
        """The middle of a cell in `map` (metres)."""
        return (
            self.origin[0] + cell[0] * self.resolution,
            self.origin[1] + cell[1] * self.resolution,
        )

    @cached_property
    def price(self) -> Floats:
        """(columns, rows) cost of a metre through each cell; infinite where the robot cannot be."""
        tightness = (COMFORT_M - self.clearance) / (COMFORT_M - FOOTPRINT_M)
        price = 1.0 + DISCOMFORT * np.clip(tightness, 0.0, 1.0) ** 2
        return np.where(self.free, price, np.inf)

    @cached_property
    def graph(self) -> csr_array[np.float64]:
        """Free cells, numbered row-major, and the cost of a step to each of their 8 neighbours."""
        numbers = np.arange(self.clearance.size, dtype=np.int32).reshape(self.clearance.shape)
        starts, ends, costs = [], [], []
        for dx, dy in ((1, 0), (0, 1), (1, 1), (1, -1)):
            here, there = _neighbours(self.free, dx, dy)
            cost = (self.price[here] + self.price[there]) / 2 * self.resolution * np.hypot(dx, dy)
            passable = np.isfinite(cost)
            starts.append(numbers[here][passable])
            ends.append(numbers[there][passable])
            costs.append(cost[passable])
        entries = np.concatenate(costs), (np.concatenate(starts), np.concatenate(ends))
        return csr_array(coo_array(entries, shape=(self.clearance.size,) * 2))


def plan(grid: OccupancyGrid, start: Point, goal: Point) -> tuple[Point, ...]:
    """The cheapest way from start to goal: points in `map` to drive through in straight lines.

    It keeps the footprint free all along and stays in the middle where there is room. Both ends are
    part of it. A start that is too close to something first leads to the nearest free cell.

    Raises:
        Unreachable: if there is no such way.
    """
    if not grid.is_free(grid.cell(goal)):
        raise Unreachable("there is no room to stand at the {place}")
    way = Reach.of(grid, start).way(goal)
    if way is None:
        raise Unreachable("the way to the {place} is blocked")
    return way


def ways(
    grid: OccupancyGrid, start: Point, goals: Sequence[Point]
) -> list[tuple[Point, ...] | None]:
    """The cheapest way to each of the goals; None where there is none.

    They are straightened in longer steps than those that are driven, which is quicker.
    """
    try:
        reach = Reach.of(grid, start)
    except Unreachable:
        return [None] * len(goals)
    return [reach.way(goal, THINNED) for goal in goals]


def reachable(grid: OccupancyGrid, start: Point) -> NDArray[np.bool_]:
    """(columns, rows) the cells that the robot can get to from where it starts.

    Raises:
        Unreachable: if it cannot move at all.
    """
    if not grid.is_free(grid.cell(start)):
        start = _nearest_free(grid, start)
    parts, _ = ndimage.label(grid.free, structure=np.ones((3, 3)))
    return np.asarray(parts == parts[grid.cell(start)])


@dataclass(frozen=True, eq=False)
class Reach:
    """All that can be reached from a point, and what it costs (both by cell, row-major).

    Attributes:
        start: where the way begins that keeps the footprint free.
        head: where the robot is, if it has to get to `start` first.
    """

    grid: OccupancyGrid
    start: Point
    head: tuple[Point, ...]
    costs: Floats
    previous: NDArray[np.int32]

    @classmethod
    def of(cls, grid: OccupancyGrid, start: Point) -> "Reach":
        """All from here; a start that is too close to something leads to the nearest free cell.

        Raises:
            Unreachable: if the robot is stuck there.
        """
        here = start if grid.is_free(grid.cell(start)) else _nearest_free(grid, start)
        first = int(np.ravel_multi_index(grid.cell(here), grid.clearance.shape))
        costs, previous = dijkstra(
            grid.graph, directed=False, indices=[first], return_predecessors=True
        )
        return cls(grid, here, () if here == start else (start,), costs[0], previous[0])

    def way(self, goal: Point, every: int = 1) -> tuple[Point, ...] | None:
        """The cheapest way there, made of every so many-th cell of it; None if there is none."""
        grid = self.grid
        if not grid.is_free(grid.cell(goal)):
            return None
        shape = grid.clearance.shape
        first, last = (int(np.ravel_multi_index(grid.cell(p), shape)) for p in (self.start, goal))
        if not np.isfinite(self.costs[last]):
            return None
        numbers = [last]
        while numbers[-1] != first:
            numbers.append(int(self.previous[numbers[-1]]))
        numbers = [first, *reversed(numbers[:-1:every])]
        cells = [divmod(number, shape[1]) for number in numbers]
        points = [self.start, *(grid.point(cell) for cell in cells[1:-1]), goal]
        return *self.head, *_straightened(grid, points, self.costs[numbers])


def _straightened(grid: OccupancyGrid, points: list[Point], costs: Floats) -> tuple[Point, ...]:
    """The points without those that a straight line may skip at (nearly) no more cost."""
    kept = [0]
    for index in range(2, len(points)):
        straight = _cost(grid, points[kept[-1]], points[index])
        if straight > (costs[index] - costs[kept[-1]]) * SLACK:
            kept.append(index - 1)
    return tuple(points[index] for index in [*kept, len(points) - 1])


def _cost(grid: OccupancyGrid, start: Point, end: Point) -> float:
    """Cost of a straight line; infinite if the robot does not fit through."""
    length = float(np.hypot(end[0] - start[0], end[1] - start[1]))
    share = np.linspace(0.0, 1.0, 2 + int(2 * length / grid.resolution))[:, None]
    points = np.asarray(start) * (1 - share) + np.asarray(end) * share
    columns, rows = np.rint((points - grid.origin) / grid.resolution).astype(int).T
    return float(grid.price[columns, rows].mean()) * length


def _nearest_free(grid: OccupancyGrid, point: Point) -> Point:
    columns, rows = np.nonzero(grid.free)
    x = grid.origin[0] + columns * grid.resolution
    y = grid.origin[1] + rows * grid.resolution
    distances = np.hypot(x - point[0], y - point[1])
    if not len(distances) or distances.min() > SNAP_M:
        raise Unreachable("I am stuck where I am")
    nearest = int(distances.argmin())
    return float(x[nearest]), float(y[nearest])


def _neighbours(grid: NDArray[np.bool_], dx: int, dy: int) -> tuple[Slices, Slices]:
    """Slices of a grid such that the second gives the neighbours by (dx, dy) of the first."""
    columns, rows = grid.shape
    low, high = max(0, -dy), rows - max(0, dy)
    here = slice(0, columns - dx), slice(low, high)
    there = slice(dx, columns), slice(low + dy, high + dy)
    return here, there


def _window(origin: Point, resolution: float, box: tuple[float, ...]) -> Slices:
    """The cells that may be within FAR_M of a rectangle: middle x and y, yaw, length and width."""
    reach = float(np.hypot(box[3], box[4])) / 2 + FAR_M
    columns, rows = (
        slice(
            max(0, int((middle - start - reach) / resolution)),
            max(0, int((middle - start + reach) / resolution) + 2),
        )
        for middle, start in zip(box[:2], origin, strict=True)
    )
    return columns, rows


def _distance_to_box(x: Floats, y: Floats, box: tuple[float, ...]) -> Floats:
    """Distance (metres) of points to a rectangle: middle x and y, yaw, length and width."""
    cos, sin = np.cos(box[2]), np.sin(box[2])
    ahead = np.abs((x - box[0]) * cos + (y - box[1]) * sin) - box[3] / 2
    aside = np.abs((y - box[1]) * cos - (x - box[0]) * sin) - box[4] / 2
    return np.asarray(np.hypot(ahead.clip(min=0.0), aside.clip(min=0.0)))
