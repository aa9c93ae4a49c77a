"""A way between two points around what is not free: RRT-Connect and path simplification by OMPL."""

from collections.abc import Callable

import numpy as np
from ompl import base, geometric, util

from executive.geometry import Floats

Free = Callable[[Floats], bool]

_STEP = 8.0
"""How far a tree grows at once."""
_SEED = 1

util.noOutputHandler()


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
    util.RNG.setSeed(_SEED)
    space = _box(lower, upper)
    setup = geometric.SimpleSetup(space)
    asked = _Asked(free, len(start))
    setup.setStateValidityChecker(asked.is_free)
    setup.setStartAndGoalStates(_state(space, start), _state(space, goal))
    planner = geometric.RRTConnect(setup.getSpaceInformation())
    planner.setRange(_STEP)
    setup.setPlanner(planner)
    tries = iter(range(samples))
    over = base.PlannerTerminationCondition(lambda: asked.failed or next(tries, None) is None)
    setup.solve(over)
    if setup.haveExactSolutionPath():
        setup.simplifySolution()
    asked.check()
    if not setup.haveExactSolutionPath():
        return None
    path = setup.getSolutionPath()
    return [_point(path.getState(i), len(start)) for i in range(path.getStateCount())]


class _Asked:
    """Answers OMPL; what is raised meanwhile must not go through its C++, but afterwards."""

    def __init__(self, free: Free, size: int) -> None:
        self._free = free
        self._size = size
        self._error: Exception | None = None

    @property
    def failed(self) -> bool:
        return self._error is not None

    def is_free(self, state: base.State) -> bool:
        if self._error is None:
            try:
                return bool(self._free(_point(state, self._size)))
            except Exception as error:
                self._error = error
        return False

    def check(self) -> None:
        """Raise what was raised."""
        if self._error is not None:
            raise self._error


def _box(lower: Floats, upper: Floats) -> base.RealVectorStateSpace:
    """The space between the bounds, where a line is checked once for each unit of length."""
    space = base.RealVectorStateSpace(len(lower))
    bounds = base.RealVectorBounds(len(lower))
    for i, (low, high) in enumerate(zip(lower, upper, strict=True)):
        bounds.setLow(i, float(low))
        bounds.setHigh(i, float(high))
    space.setBounds(bounds)
    space.setLongestValidSegmentFraction(1.0 / space.getMaximumExtent())
    return space


def _state(space: base.RealVectorStateSpace, point: Floats) -> base.State:
    state = space.allocState()
    for i, value in enumerate(point):
        state[i] = float(value)
    return state


def _point(state: base.State, size: int) -> Floats:
    return np.array([state[i] for i in range(size)])
