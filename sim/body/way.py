"""A piecewise linear path, interpolated for all coordinates at once."""

from bisect import bisect_right

import numpy as np

from executive.geometry import Floats


class Way:
    """The same as `np.interp` of each coordinate, bit for bit, in a fifth of the time.

    It is used several times in each control period.
    """

    def __init__(self, along: Floats, points: Floats) -> None:
        """Pass through `points` (n, any) at `along` (n,), non-decreasing lengths or times."""
        self._along = along
        self._each = along.tolist()
        self._points = points
        self._slopes = np.zeros_like(points)  # zero after the last point: it stays there
        moves = np.diff(along) > 0
        self._slopes[:-1][moves] = np.diff(points, axis=0)[moves] / np.diff(along)[moves, None]

    def at(self, length: float) -> Floats:
        """The point (any,) at a length, which must not be before the start."""
        index = bisect_right(self._each, length) - 1
        point: Floats = self._slopes[index] * (length - self._each[index]) + self._points[index]
        return point

    def at_each(self, lengths: Floats) -> Floats:
        """The points (m, any) at lengths (m,), none of them before the start."""
        index = self._along.searchsorted(lengths, side="right") - 1
        off = (lengths - self._along[index])[:, None]
        points: Floats = self._slopes[index] * off + self._points[index]
        return points
