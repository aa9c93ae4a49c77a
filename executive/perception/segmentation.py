"""Segments the object in a detector's box by depth, since such a box has no mask.

In `map`, where z is up, the support of the object is level and below it, and what is behind or
beside it is separated from it. Pure functions of arrays.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from executive.geometry import Floats, back_project_grid
from executive.types.perception import Box, Frame

Mask = NDArray[np.bool_]

AROUND = 0.25
"""Margin around the box in which to look for the support (share of the box's sides)."""
LEAST_AROUND = 8
"""The smallest such margin in pixels."""
LEVEL = 0.97
"""A surface is level if the cosine between its normal and upward is above this."""
BIN_M = 0.004
"""Size of the bins into which heights are sorted."""
ABOVE_M = 0.005
"""A pixel lower than this above the support belongs to the support."""
STEP_M = 0.012
"""Neighbouring pixels farther apart than this are on different surfaces."""
JOINED_M = 0.035
"""A part that is mostly in the box, and this near to the object, belongs to it."""
NEAR_M = 0.015
"""A part farther outside the block around the main part belongs to another object."""
_FEW = 0.06
"""A height with a smaller share of the level pixels is not the support."""
_LEAST_RISING = 0.08
_MOST_SINKING = 0.1
"""Limits for the shares of the box above and below the support."""
HIGHEST_M = 0.27
"""The largest height of an object; what is farther below its support is background."""
_IN_BOX = 0.6
"""A part with a larger share of its pixels in the box than this is mostly in the box."""
_LINKS = 3
"""The longest chain of parts that belong to the object because each is near the one before."""
_MOSTLY = 0.7
"""A part with this share in the block around the main one belongs to it."""
_MIDDLE = 0.3
"""Standard deviation, in sides of the box, of the weight of pixels around its centre."""


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """Pairs of neighbouring pixels (n,), by their numbers in the grid, and their distance (m)."""

    starts: NDArray[np.intp]
    ends: NDArray[np.intp]
    distances: Floats


def segment(frame: Frame, box: Box) -> Mask:
    """The mask (box.height, box.width) of the object in a box of the picture.

    It is the whole box if no pixel in it has depth and is above the support.
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
    steps = steps_between(points, candidates)
    parts = parts_of(candidates, steps)
    if not parts[inside].any():
        return np.ones((box.height, box.width), np.bool_)
    main = main_part(parts, inside)
    return those_with(main, points, parts, steps, inside)[parts[inside]]


def _around(box: Box, frame: Frame) -> tuple[slice, slice]:
    """Rows and columns of the box with its margin, within the picture."""
    height, width = frame.depth.shape
    down = max(LEAST_AROUND, round(AROUND * box.height))
    across = max(LEAST_AROUND, round(AROUND * box.width))
    return (
        slice(max(0, box.top - down), min(height, box.top + box.height + down)),
        slice(max(0, box.left - across), min(width, box.left + box.width + across)),
    )


def support_height(points: Floats, inside: tuple[slice, slice]) -> float | None:
    """The height (z, metres) of the support of the object in a box; None if it is not visible.

    That is the highest level surface beside and below the foot of the box for which something in
    the box is above it and hardly anything below: other surfaces are the tops of neighbours.

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
    """Mask (h, w) of level pixels, by the upper left, upper right and lower left neighbours."""
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


def parts_of(candidates: Mask, steps: Steps) -> NDArray[np.int32]:
    """Label (h, w) the connected surfaces among the candidates from 1; 0 elsewhere."""
    near = steps.distances < STEP_M
    joined = (np.ones(near.sum()), (steps.starts[near], steps.ends[near]))
    graph = coo_array(joined, shape=(candidates.size,) * 2)
    _, labels = connected_components(graph, directed=False)
    parts = np.zeros(candidates.shape, np.int32)
    chosen = labels.reshape(candidates.shape)[candidates]
    parts[candidates] = np.unique(chosen, return_inverse=True)[1] + 1
    return parts


def steps_between(points: Floats, candidates: Mask) -> Steps:
    """The distances between neighbouring candidates (h, w), in all eight directions."""
    numbers = np.arange(candidates.size).reshape(candidates.shape)
    starts, ends, distances = [], [], []
    for one, other in (
        (np.s_[:, :-1], np.s_[:, 1:]),
        (np.s_[:-1], np.s_[1:]),
        (np.s_[:-1, :-1], np.s_[1:, 1:]),
        (np.s_[:-1, 1:], np.s_[1:, :-1]),
    ):
        both = candidates[one] & candidates[other]
        starts.append(numbers[one][both])
        ends.append(numbers[other][both])
        distances.append(np.linalg.norm(points[one][both] - points[other][both], axis=-1))
    return Steps(np.concatenate(starts), np.concatenate(ends), np.concatenate(distances))


def main_part(parts: NDArray[np.int32], inside: tuple[slice, slice]) -> int:
    """The label of the part that best fills the middle of the box, and extends least outside it.

    Raises:
        ValueError: if there is no part at all.
    """
    in_box = parts[inside]
    height, width = in_box.shape
    row = (np.arange(height) + 0.5) / height - 0.5
    column = (np.arange(width) + 0.5) / width - 0.5
    weight = np.exp(-(row[:, None] ** 2 + column**2) / (2 * _MIDDLE**2))
    filled = np.bincount(in_box.ravel(), weight.ravel(), int(parts.max()) + 1)
    return int((filled * shares_inside(parts, inside) ** 2)[1:].argmax()) + 1


def shares_inside(parts: NDArray[np.int32], inside: tuple[slice, slice]) -> Floats:
    """The share of each part, by label, that is in the box."""
    sizes = np.bincount(parts.ravel())
    return np.asarray(
        np.bincount(parts[inside].ravel(), minlength=len(sizes)) / np.maximum(sizes, 1)
    )


def those_with(
    main: int, points: Floats, parts: NDArray[np.int32], steps: Steps, inside: tuple[slice, slice]
) -> Mask:
    """Mask, by label, of the parts that belong to the same object as the main one.

    Those are the parts in the block around and below it, such as the bottom of a mug; and parts
    mostly in the box with only a small gap to the object, such as the shaft of a spatula.
    """
    count = int(parts.max()) + 1
    thing = points[parts == main]
    low, high = np.quantile(thing, 0.02, axis=0) - NEAR_M, np.quantile(thing, 0.98, axis=0) + NEAR_M
    low[2] = -np.inf
    with np.errstate(invalid="ignore"):
        in_block = ((points > low) & (points < high)).all(-1)
    within = np.bincount(parts.ravel(), in_block.ravel(), count)
    chosen = within > _MOSTLY * np.bincount(parts.ravel(), minlength=count)
    chosen[main] = True
    in_box = shares_inside(parts, inside) > _IN_BOX
    touching = steps.distances < JOINED_M
    one, other = (parts.ravel()[ends[touching]] for ends in (steps.starts, steps.ends))
    for _ in range(_LINKS):
        reached = np.zeros(count, np.bool_)
        reached[other[chosen[one]]] = reached[one[chosen[other]]] = True
        chosen |= reached & in_box
    chosen[0] = False
    return chosen
