"""RRT-Connect: a way between two points around what is not free (Kuffner and LaValle, 2000).

Two trees grow, one from each end: one a step towards a random point, the other as far as it can
towards what the first has reached, until they meet. The way is then shortened.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Free = Callable[[Floats], bool]

_STEP = 4.0
"""How far a tree grows at once."""
_SHORTCUTS = 40
_SEED = 0


def connect(
    start: Floats, goal: Floats, lower: Floats, upper: Floats, free: Free, samples: int
) -> list[Floats] | None:
    """Points to pass in straight lines from start to goal, both included; None if none are found.

    The same question has always the same answer.

    Args:
        start: the first point, free.
        goal: the last point, free.
        lower: bounds of the space.
        upper: bounds of the space.
        free: whether a point is; asked at least once for each unit of length.
        samples: random points that are tried, at most.
    """
    chance = np.random.default_rng(_SEED)
    here, there = _Tree(start, free), _Tree(goal, free)
    for _ in range(samples):
        reached = here.extend(chance.uniform(lower, upper), once=True)
        if reached is not None:
            met = there.extend(here.points[reached], once=False)
            if met is not None and np.array_equal(there.points[met], here.points[reached]):
                way = [*reversed(here.branch(reached)), *there.branch(met)[1:]]
                forward = way if way[0] is start else way[::-1]
                return _shortened(forward, free, chance)
        here, there = there, here
    return None


class _Tree:
    """Points that are reached from a root."""

    def __init__(self, root: Floats, free: Free) -> None:
        self.points, self._parents, self._free = [root], [0], free

    def extend(self, target: Floats, once: bool) -> int | None:
        """Grow towards a point, by one step or as far as it goes; the last new point, if any."""
        nearest = int(np.linalg.norm(np.array(self.points) - target, axis=1).argmin())
        last = None
        while True:
            way = target - self.points[nearest]
            length = float(np.linalg.norm(way))
            new = target if length <= _STEP else self.points[nearest] + _STEP / length * way
            if length == 0.0 or not _is_free(self.points[nearest], new, self._free):
                return last
            self.points.append(new)
            self._parents.append(nearest)
            last = nearest = len(self.points) - 1
            if once or new is target:
                return last

    def branch(self, index: int) -> list[Floats]:
        """The points from this one down to the root."""
        way = [self.points[index]]
        while index:
            index = self._parents[index]
            way.append(self.points[index])
        return way


def _shortened(way: list[Floats], free: Free, chance: np.random.Generator) -> list[Floats]:
    for _ in range(_SHORTCUTS):
        if len(way) < 3:
            break
        first, last = sorted(chance.choice(len(way), 2, replace=False))
        if last - first > 1 and _is_free(way[first], way[last], free):
            way = [*way[: first + 1], *way[last:]]
    return way


def _is_free(start: Floats, end: Floats, free: Free) -> bool:
    """Whether a straight line is, but for its start."""
    count = max(1, int(np.ceil(np.linalg.norm(end - start))))
    return all(free(start + part * (end - start)) for part in np.linspace(0, 1, count + 1)[1:])
