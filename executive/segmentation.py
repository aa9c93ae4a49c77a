"""Which pixels of a box are the thing: found in the depth, since a detector's box has no mask.

In `map`, where z is up: what the thing stands on is level and lies below it, what is behind or
beside it is apart from it. Pure functions over arrays.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from executive.perception import back_project_grid
from executive.types import Box, Frame

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

AROUND = 0.25
"""How much more than the box is looked at, for what the thing stands on (share of its sides)."""
LEAST_AROUND = 8
"""The same in pixels, at least."""
LEVEL = 0.97
"""Cosine between upward and the normal of what counts as level."""
BIN_M = 0.004
ABOVE_M = 0.005
"""Lower than this above what it stands on, a pixel belongs to that."""
STEP_M = 0.012
"""Neighbouring pixels farther apart than this are not of one surface."""
NEAR_M = 0.015
"""Farther than this outside the block around its largest part, a part is of something else."""
_FEW = 0.06
"""A level with a smaller share of the level pixels is not what the thing stands on."""
_LEAST_RISING = 0.08
_MOST_SINKING = 0.1
"""Shares of the box above and below what the thing stands on."""
HIGHEST_M = 0.27
"""No thing is higher; what is farther below is the background."""
_MOSTLY = 0.7
"""A part with this share in the block around the largest one belongs to it."""
_MIDDLE = 0.3
"""Standard deviation, in sides of the box, of how much a pixel counts by its place in the box."""


def segment(frame: Frame, box: Box) -> Mask:
    """The pixels (box.height, box.width) of the thing that a box in the picture is around.

    All of the box where there is no depth to tell.
    """
    rows, columns = _around(box, frame)
    points = back_project_grid(frame, rows, columns)
    inside = (
        slice(box.top - rows.start, box.top - rows.start + box.height),
        slice(box.left - columns.start, box.left - columns.start + box.width),
    )
    ground = support_height(points, inside)
    candidates = np.isfinite(points[..., 2])
    if ground is not None:
        candidates &= points[..., 2] > ground + ABOVE_M
    parts = parts_of(points, candidates)
    if not parts[inside].any():
        return np.ones((box.height, box.width), np.bool_)
    return _join(points[inside], parts[inside], np.bincount(parts.ravel()))


def _around(box: Box, frame: Frame) -> tuple[slice, slice]:
    """Rows and columns of the box and what is around it, within the picture."""
    height, width = frame.depth.shape
    down = max(LEAST_AROUND, round(AROUND * box.height))
    across = max(LEAST_AROUND, round(AROUND * box.width))
    return (
        slice(max(0, box.top - down), min(height, box.top + box.height + down)),
        slice(max(0, box.left - across), min(width, box.left + box.width + across)),
    )


def support_height(points: Floats, inside: tuple[slice, slice]) -> float | None:
    """The height (z, metres) of what the thing in a box stands on; None if it is not in sight.

    That is the highest level surface beside and below the foot of the box that something in the
    box rises above and hardly anything goes on below: other surfaces are the tops of neighbours.

    Args:
        points: (h, w, 3) in `map`, not finite where nothing was measured.
        inside: rows and columns of the box.
    """
    rows, columns = inside
    beside = _is_level(points)
    beside[: rows.stop - max(2, (rows.stop - rows.start) // 3)] = False
    beside[rows, columns] = False
    heights = points[beside][:, 2]
    if len(heights) < LEAST_AROUND:
        return None
    bins = np.round(heights / BIN_M).astype(int)
    within = points[inside][..., 2]
    for one in sorted(set(bins.tolist()), reverse=True):
        same = np.abs(bins - one) <= 1
        height = float(np.median(heights[same]))
        rising = (within > height + ABOVE_M).mean()
        sinking = ((within < height - ABOVE_M) & (within > height - HIGHEST_M)).mean()
        enough = same.sum() >= max(LEAST_AROUND, _FEW * len(heights))
        if enough and rising > _LEAST_RISING and sinking < _MOST_SINKING:
            return height
    return None


def _is_level(points: Floats) -> Mask:
    """Where (h, w) the surface is level, by the points two pixels to the right and below."""
    level = np.zeros(points.shape[:2], np.bool_)
    if min(level.shape) < 3:
        return level
    across = points[:-2, 2:] - points[:-2, :-2]
    down = points[2:, :-2] - points[:-2, :-2]
    normal = np.cross(across, down)
    with np.errstate(invalid="ignore"):
        upright = np.abs(normal[..., 2]) > LEVEL * np.linalg.norm(normal, axis=-1)
    level[1:-1, 1:-1] = upright & np.isfinite(normal).all(-1)
    return level


def parts_of(points: Floats, candidates: Mask) -> NDArray[np.int32]:
    """Numbers (h, w) from 1 of the connected surfaces among the candidates; 0 elsewhere."""
    numbers = np.arange(candidates.size).reshape(candidates.shape)
    starts, ends = [], []
    for one, other in (
        (np.s_[:, :-1], np.s_[:, 1:]),
        (np.s_[:-1], np.s_[1:]),
        (np.s_[:-1, :-1], np.s_[1:, 1:]),
        (np.s_[:-1, 1:], np.s_[1:, :-1]),
    ):
        with np.errstate(invalid="ignore"):
            near = np.linalg.norm(points[one] - points[other], axis=-1) < STEP_M
        joined = near & candidates[one] & candidates[other]
        starts.append(numbers[one][joined])
        ends.append(numbers[other][joined])
    start, end = np.concatenate(starts), np.concatenate(ends)
    graph = coo_array((np.ones(len(start)), (start, end)), shape=(candidates.size,) * 2)
    _, labels = connected_components(graph, directed=False)
    parts = np.zeros(candidates.shape, np.int32)
    _, parts[candidates] = np.unique(
        labels.reshape(candidates.shape)[candidates], return_inverse=True
    )
    parts[candidates] += 1
    return parts


def _join(points: Floats, parts: NDArray[np.int32], sizes: NDArray[np.int64]) -> Mask:
    """The part that fills the middle of the box best, and those in the block around and below it.

    Of a part that goes on outside of the box, where `sizes` counts it too, less is thought.
    """
    height, width = parts.shape
    row = (np.arange(height) + 0.5) / height - 0.5
    column = (np.arange(width) + 0.5) / width - 0.5
    weight = np.exp(-(row[:, None] ** 2 + column**2) / (2 * _MIDDLE**2))
    count = len(sizes)
    inside = np.bincount(parts.ravel(), minlength=count)
    filled = (
        np.bincount(parts.ravel(), weight.ravel(), count) * (inside / np.maximum(sizes, 1)) ** 2
    )
    thing = parts == int(filled[1:].argmax()) + 1
    low = np.quantile(points[thing], 0.02, axis=0) - NEAR_M
    low[2] = -np.inf
    high = np.quantile(points[thing], 0.98, axis=0) + NEAR_M
    with np.errstate(invalid="ignore"):
        in_block = ((points > low) & (points < high)).all(-1) & (parts > 0)
    within = np.bincount(parts.ravel(), in_block.ravel(), count) / np.maximum(sizes, 1)
    return np.asarray((within > _MOSTLY)[parts] & (parts > 0) | thing)
