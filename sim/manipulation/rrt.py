"""Plans a collision-free path between two points with OMPL's RRT-Connect, and simplifies it."""

from collections.abc import Callable

import numpy as np
from ompl import base, geometric, util

from executive.geometry import Floats

Free = Callable[[Floats], bool]

_STEP = 8.0
"""The longest extension of a tree in one step."""
_SEED = 1

util.noOutputHandler()


def connect(
    start: Floats, goal: Floats, lower: Floats, upper: Floats, free: Free, samples: int
) -> list[Floats] | None:
    """Points joined by straight lines from start to goal, both included; None if none are found.

    The result is deterministic.

    Args:
        start: the first point (k,), which must be free.
        goal: the last point (k,), which must be free.
        lower: lower bounds (k,) of the space.
        upper: upper bounds (k,) of the space.
        free: whether a point is free; called at least once per unit of length.
        samples: the most random samples.
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
    """OMPL's callback; keeps an exception, which must not pass through C++, and raises it later."""

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
        """Raise the exception of the callback, if there was one."""
        if self._error is not None:
            raise self._error


def _box(lower: Floats, upper: Floats) -> base.RealVectorStateSpace:
    """The space between the bounds; OMPL checks lines in it once per unit of length."""
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
