"""Many small least-squares problems solved together, with a loss that bears with outliers."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats

_NOISE_M = 0.003
"""What is farther off than this counts less and less (soft L1 loss)."""
_SCALE: Floats = np.array([0.01, 0.01, 0.01, 0.2])
"""Steps of x, y, z and yaw that change about as much (metres, radians)."""
_DAMPING, _WORSE, _BETTER = 1e-3, 10.0, 0.2
"""Of the first step, and how it changes after one that was none or a good one."""
_LEAST_DAMPING, _LEAST_BEND = 1e-8, 1e-9
"""Keep a step finite in what nothing depends on, as the yaw of a ball."""
_LEAST_GAIN = 1e-5
"""The share of its cost that a step takes off at least, or it was the last."""
_LEAST_STEP = 1e-3
"""And how long it is at least, in steps of `_SCALE`."""
Off = Callable[[Floats, NDArray[np.intp]], tuple[Floats, Floats]]


def least_squares(
    off: Off, starts: Floats, which: NDArray[np.intp], steps: int
) -> tuple[Floats, Floats]:
    """Fits (x, y, z, yaw) from each start, by Levenberg's and Marquardt's method.

    Args:
        off: how far things are off (g, n) and the derivatives (g, n, 4), for some guesses (g, 4)
            and what each of them is of (g,).
        starts: guesses (g, 4).
        which: what each of them is of (g,); handed to `off`.
        steps: at most.

    Returns:
        The fits (g, 4), and what each costs (g,).
    """
    fits, left = starts.copy(), np.arange(len(starts))
    costs, slopes, bends = _quadratic(*off(fits, which))
    damping, all_costs = np.full(len(fits), _DAMPING), costs.copy()
    for _ in range(steps):
        step = _step(slopes, bends, damping)
        tried = fits[left] + step
        new = _quadratic(*off(tried, which[left]))
        better = new[0] < costs
        fits[left[better]] = tried[better]
        small = (np.abs(step) / _SCALE).max(axis=1) < _LEAST_STEP
        done = small | (better & (costs - new[0] < _LEAST_GAIN * costs))
        costs = np.where(better, new[0], costs)
        slopes = np.where(better[:, None], new[1], slopes)
        bends = np.where(better[:, None, None], new[2], bends)
        damping = np.maximum(damping * np.where(better, _BETTER, _WORSE), _LEAST_DAMPING)
        all_costs[left] = costs
        goes_on = ~done
        left, costs, damping = left[goes_on], costs[goes_on], damping[goes_on]
        slopes, bends = slopes[goes_on], bends[goes_on]
        if not len(left):
            break
    return fits, all_costs


def _quadratic(off: Floats, derivatives: Floats) -> tuple[Floats, Floats, Floats]:
    """Costs (g,) with their slopes (g, 4) and bends (g, 4, 4), in steps of `_SCALE`."""
    derivatives = derivatives * _SCALE
    square = (off / _NOISE_M) ** 2
    root = np.sqrt(1 + square)
    cost = _NOISE_M**2 * (root - 1).sum(axis=1)
    slope = np.einsum("gnk,gn->gk", derivatives, off / root)
    bend = derivatives.transpose(0, 2, 1) @ (derivatives / (root**3)[:, :, None])
    return cost, slope, bend


def _step(slopes: Floats, bends: Floats, damping: Floats) -> Floats:
    diagonal = np.einsum("gkk->gk", bends)
    damped = bends.copy()
    index = np.arange(4)
    damped[:, index, index] += damping[:, None] * (diagonal + _LEAST_BEND)
    step: Floats = -np.linalg.solve(damped, slopes[:, :, None])[:, :, 0] * _SCALE
    return step
