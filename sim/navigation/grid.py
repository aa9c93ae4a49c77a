"""Path planning for a round robot: a grid of clearances, and the cheapest path on it.

The map is the home's plan with walls, furniture and the person; objects on the floor are not in it.
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
"""Cells with less clearance than this cost extra."""
FAR_M = 1.0
"""Clearance is cut off at this distance."""
DISCOMFORT = 4.0
"""The extra cost of a metre where the robot just fits; a metre in free space costs 1."""
PERSON_RADIUS_M = 0.25
SLACK = 1.02
"""A straight line may replace a part of the path if it costs at most this many times as much."""
THINNED = 6
"""When many paths are planned, only every sixth cell of each is kept, for speed."""
SNAP_M = 0.25
"""The start may be this far from the nearest free cell: the robot can leave tight places."""


class Unreachable(Exception):
    """There is no path; the text says why, as a clause with `{place}` for the name of the goal."""

    def clause(self, place: str) -> str:
        """The reason with the name of the goal: "the way to the desk is blocked"."""
        return str(self).format(place=place)


@dataclass(frozen=True, eq=False)
class OccupancyGrid:
    """The distance of each cell to the nearest obstacle.

    Attributes:
        origin: centre of cell [0, 0] in `map` (metres).
        resolution: side of a cell (metres).
        clearance: (columns, rows) distance from the centre of a cell to the nearest wall, furniture
            or person (metres, at most FAR_M); 0 inside them. Columns go along x, rows along y.
    """

    origin: Point
    resolution: float
    clearance: Floats

    @classmethod
    def from_home(cls, home: Home, resolution: float = 0.05) -> "OccupancyGrid":
        """The grid of a home's plan; everything outside the rooms is an obstacle."""
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
        """A grid with additional obstacles at points (n, 2) (metres, in `map`)."""
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
        """(n,) clearance of the cells of points (n, 2) in `map` (metres); 0 off the grid."""
        columns, rows = self.cells(points).T
        shape = self.clearance.shape
        on_grid = (columns >= 0) & (columns < shape[0]) & (rows >= 0) & (rows < shape[1])
        found = np.zeros(len(points))
        found[on_grid] = self.clearance[columns[on_grid], rows[on_grid]]
        return found

    def cells(self, points: Floats) -> NDArray[np.intp]:
        """(n, 2) column and row of the cells of points (n, 2) in `map`; may be off the grid."""
        return np.rint((points - self.origin) / self.resolution).astype(np.intp)

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """(columns, rows) whether the robot fits with its centre anywhere in the cell."""
        return np.asarray(self.clearance >= FOOTPRINT_M + self.resolution)

    def is_free(self, cell: tuple[int, int]) -> bool:
        """Whether a cell is on the grid and free."""
        columns, rows = self.free.shape
        return 0 <= cell[0] < columns and 0 <= cell[1] < rows and bool(self.free[cell])

    def cell(self, point: Point) -> tuple[int, int]:
        """Column and row of the cell of a point (metres, in `map`); may be off the grid."""
        column, row = (
            round((value - start) / self.resolution)
            for value, start in zip(point, self.origin, strict=True)
        )
        return column, row

    def point(self, cell: tuple[int, int]) -> Point:
        """The centre of a cell in `map` (metres)."""
        return (
            self.origin[0] + cell[0] * self.resolution,
            self.origin[1] + cell[1] * self.resolution,
        )

    @cached_property
    def price(self) -> Floats:
        """(columns, rows) cost of a metre through each cell; infinite where it is not free."""
        tightness = (COMFORT_M - self.clearance) / (COMFORT_M - FOOTPRINT_M)
        price = 1.0 + DISCOMFORT * np.clip(tightness, 0.0, 1.0) ** 2
        return np.where(self.free, price, np.inf)

    @cached_property
    def graph(self) -> csr_array[np.float64]:
        """The cost of a step from each free cell to its 8 neighbours; cells in row-major order.

        Each pair of cells has one entry: the graph is undirected.
        """
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
    """The cheapest path from start to goal, as way-points joined by straight lines (m, in `map`).

    It keeps the footprint free, and some distance to obstacles where there is room. The path
    includes start and goal. If the start is not free, it leads to the nearest free cell first.

    Raises:
        Unreachable: if there is no such path.
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
    """The cheapest path to each goal; None for goals that cannot be reached.

    These paths are for estimates: they are coarser than those of `plan`, and faster to compute.
    """
    try:
        reach = Reach.of(grid, start)
    except Unreachable:
        return [None] * len(goals)
    return [reach.way(goal, THINNED) for goal in goals]


def reachable(grid: OccupancyGrid, start: Point) -> NDArray[np.bool_]:
    """(columns, rows) whether the robot can reach each cell from `start`.

    Raises:
        Unreachable: if there is no free cell near the start.
    """
    if not grid.is_free(grid.cell(start)):
        start = _nearest_free(grid, start)
    parts, _ = ndimage.label(grid.free, structure=np.ones((3, 3)))
    return np.asarray(parts == parts[grid.cell(start)])


@dataclass(frozen=True, eq=False)
class Reach:
    """The shortest-path tree from a point.

    Attributes:
        start: the root, in a free cell (metres, in `map`).
        head: the robot's position, if it has to move to `start` first; else empty.
        costs: of the path to each cell (row-major); infinite if there is none.
        previous: the cell before each cell on its path (row-major).
    """

    grid: OccupancyGrid
    start: Point
    head: tuple[Point, ...]
    costs: Floats
    previous: NDArray[np.int32]

    @classmethod
    def of(cls, grid: OccupancyGrid, start: Point) -> "Reach":
        """Compute the tree; a start that is not free is moved to the nearest free cell.

        Raises:
            Unreachable: if there is no free cell near the start.
        """
        here = start if grid.is_free(grid.cell(start)) else _nearest_free(grid, start)
        first = int(np.ravel_multi_index(grid.cell(here), grid.clearance.shape))
        costs, previous = dijkstra(
            grid.graph, directed=False, indices=[first], return_predecessors=True
        )
        return cls(grid, here, () if here == start else (start,), costs[0], previous[0])

    def way(self, goal: Point, every: int = 1) -> tuple[Point, ...] | None:
        """The cheapest path to a goal, by every `every`-th of its cells; None if there is none."""
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
    """The points without those that a straight line can skip at (nearly) the same cost.

    `costs` (n,) are the costs of the path up to each point.
    """
    kept = [0]
    for index in range(2, len(points)):
        straight = _cost(grid, points[kept[-1]], points[index])
        if straight > (costs[index] - costs[kept[-1]]) * SLACK:
            kept.append(index - 1)
    return tuple(points[index] for index in [*kept, len(points) - 1])


def _cost(grid: OccupancyGrid, start: Point, end: Point) -> float:
    """Cost of a straight line; infinite if it passes a cell that is not free."""
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
    """Two slices of a grid: cells, and their neighbours at the offset (dx, dy)."""
    columns, rows = grid.shape
    low, high = max(0, -dy), rows - max(0, dy)
    here = slice(0, columns - dx), slice(low, high)
    there = slice(dx, columns), slice(low + dy, high + dy)
    return here, there


def _window(origin: Point, resolution: float, box: tuple[float, ...]) -> Slices:
    """The cells that may be within FAR_M of a rectangle: centre x and y, yaw, length and width."""
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
    """Distance (metres) of points to a rectangle: centre x and y, yaw, length and width."""
    cos, sin = np.cos(box[2]), np.sin(box[2])
    ahead = np.abs((x - box[0]) * cos + (y - box[1]) * sin) - box[3] / 2
    aside = np.abs((y - box[1]) * cos - (x - box[0]) * sin) - box[4] / 2
    return np.asarray(np.hypot(ahead.clip(min=0.0), aside.clip(min=0.0)))
