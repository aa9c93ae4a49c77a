"""Finds overlapping rectangles: first by bounding boxes, then by separating axes."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats

Corners = Sequence[tuple[float, float]]


def overlapping(outlines: Sequence[Corners]) -> Iterator[tuple[int, int]]:
    """Pairs of indices of rectangles that overlap, the smaller index first; edges may touch.

    Args:
        outlines: the four corners of each rectangle, in order around it (metres).
    """
    corners = np.asarray(outlines, float).reshape(-1, 4, 2)
    low, high = corners.min(axis=1), corners.max(axis=1)
    for index in range(len(corners) - 1):
        rest = slice(index + 1, None)
        near = ((low[rest] < high[index]) & (high[rest] > low[index])).all(axis=1)
        others = index + 1 + np.flatnonzero(near)
        if len(others):
            apart = _beyond(corners[index], corners[others]) | _beyond(
                corners[others], corners[index]
            )
            yield from ((index, int(other)) for other in others[~apart])


def _beyond(rectangles: Floats, others: Floats) -> NDArray[np.bool_]:
    """Whether a side of the one rectangle separates it from the other; broadcasts."""
    start = rectangles[..., 2, :]
    apart: NDArray[np.bool_] = np.zeros((), bool)
    for end in (rectangles[..., 1, :], rectangles[..., 3, :]):
        side = end - start
        along = ((others - start[..., None, :]) * side[..., None, :]).sum(axis=-1)
        length = (side * side).sum(axis=-1)
        apart = apart | (along.min(axis=-1) >= length) | (along.max(axis=-1) <= 0)
    return apart
