"""A way of straight pieces: where one is on it, for all coordinates at once."""

from bisect import bisect_right

import numpy as np

from executive.geometry import Floats


class Way:
    """What `np.interp` says of each coordinate, to the bit, in a fifth of the time.

    It is asked several times in each control period.
    """

    def __init__(self, along: Floats, points: Floats) -> None:
        """Go through `points` (n, any) at these lengths or times (n,), which never fall."""
        self._along = along
        self._each = along.tolist()
        self._points = points
        self._slopes = np.zeros_like(points)  # behind the end it stays where it is
        moves = np.diff(along) > 0
        self._slopes[:-1][moves] = np.diff(points, axis=0)[moves] / np.diff(along)[moves, None]

    def at(self, length: float) -> Floats:
        """The point (any,) at a length that is not before the start."""
        index = bisect_right(self._each, length) - 1
        point: Floats = self._slopes[index] * (length - self._each[index]) + self._points[index]
        return point

    def at_each(self, lengths: Floats) -> Floats:
        """The points (m, any) at lengths (m,) that are not before the start."""
        index = self._along.searchsorted(lengths, side="right") - 1
        off = (lengths - self._along[index])[:, None]
        points: Floats = self._slopes[index] * off + self._points[index]
        return points
