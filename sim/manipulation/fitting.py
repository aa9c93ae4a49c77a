"""Solves many small least-squares problems at once, with a loss that is robust to outliers."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats

_NOISE_M = 0.003
"""Scale of the soft L1 loss: larger residuals have less weight."""
_SCALE: Floats = np.array([0.01, 0.01, 0.01, 0.2])
"""Scale of x, y, z and yaw: changes by these have about the same effect (metres, radians)."""
_DAMPING, _WORSE, _BETTER = 1e-3, 10.0, 0.2
"""Damping of the first step, and its factors after a rejected and after an accepted step."""
_LEAST_DAMPING, _LEAST_BEND = 1e-8, 1e-9
"""Keep steps finite along parameters without effect, such as the yaw of a ball."""
_LEAST_GAIN = 1e-5
"""A fit ends when a step reduces its cost by less than this fraction."""
_LEAST_STEP = 1e-3
"""A fit also ends when its step is smaller than this, in units of `_SCALE`."""
Off = Callable[[Floats, NDArray[np.intp]], tuple[Floats, Floats]]


def least_squares(
    off: Off, starts: Floats, which: NDArray[np.intp], steps: int
) -> tuple[Floats, Floats]:
    """Fit (x, y, z, yaw) from each start, with the Levenberg-Marquardt method.

    Args:
        off: returns the residuals (g, n) and their derivatives (g, n, 4), for guesses (g, 4) and
            the number of the problem (g,) that each belongs to.
        starts: start values (g, 4).
        which: the number of the problem (g,) of each start; passed to `off`.
        steps: the most steps.

    Returns:
        The fits (g, 4) and their costs (g,).
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
    """Costs (g,), gradients (g, 4) and approximate Hessians (g, 4, 4), in units of `_SCALE`."""
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
