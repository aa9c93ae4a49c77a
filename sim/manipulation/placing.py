"""Finding a free spot on a piece of furniture for a thing that is in the hand."""

from collections.abc import Iterator
from itertools import product

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats, heading
from executive.types.geometry import Pose
from sim.home.furniture import OPEN, Furniture, Surface
from sim.manipulation.clutter import level_points, rising_points
from sim.objects.objects import ObjectModel

RIM_M = 0.13
"""From the front edge of a surface to the middle of what is put there, for the reach of an arm."""
MARGIN_M = 0.02
"""From the outline of a thing to the edge of its surface."""
CLEAR_M = 0.06
"""Around the outline of a thing, for the fingers."""
TIGHT_M = 0.04
"""What is left of that where there is no better spot."""
HEADROOM_M = 0.05
DROP_M = 0.002
"""How far above the surface a thing is let go."""
_SHIFTED_M = 0.03
"""A thing may slide this far when it is let go."""
FLAT_M = 0.012
"""Lower than this above a surface, the camera does not tell a thing from it."""
_UPRIGHT_M = 0.015
"""What stands is as high as it should be, but for this and a tenth of it."""
_STEP_M, _ROW_M = 0.04, 0.08
"""Between places along the front, and between rows of them (metres)."""
_CELL_M, _SEEN = 0.05, 0.8
"""Behind the front row, so much of a spot must be seen, by cells: things hide what is behind."""
_FEW_POINTS = 3
_TURNS = (0.0, np.pi, np.pi / 2, -np.pi / 2)


def free_spots(
    piece: Furniture, surface: Surface, model: ObjectModel, seen: Floats, turn: float = 0.0
) -> Iterator[Pose]:
    """Poses in `map` on a surface where the thing can stand, the handiest first.

    Args:
        piece: the furniture, as the map knows it.
        surface: one of its surfaces.
        model: what is to be put down.
        seen: points (n, 3) in `map` that the depth camera sees now; what rises above the surface
            is in the way.
        turn: how the thing is best turned, seen from the furniture (radians); then come quarters.
    """
    if model.size[2] + HEADROOM_M > surface.clearance:
        return
    level = level_points(piece, surface, seen)[:, :2]
    rising = rising_points(piece, surface, seen)[:, :2]
    outlines = [(turn + quarter, *_outline(model, turn + quarter)) for quarter in _TURNS]
    for clear, (row, y) in product((CLEAR_M, TIGHT_M), _places(surface)):
        for turned, lower, upper in outlines:
            x = surface.length_x / 2 - max(RIM_M, upper[0] + MARGIN_M) - row
            low, high = lower + (x, y), upper + (x, y)
            if not _fits(surface, low[1], high[1]) or not _has_room(rising, low, high, clear):
                continue
            if clear == TIGHT_M and _has_room(rising, low, high, CLEAR_M):
                continue  # it was tried before
            if row and not (_fits_behind(surface, low[0]) and _is_seen(level, low, high)):
                continue
            middle = np.add(surface.center, (x, y, DROP_M))
            yield _pose(piece, (middle[0], middle[1], middle[2]), turned)


def stands(model: ObjectModel, spot: Pose, seen: Floats, clearance: float = OPEN) -> str | None:
    """What is wrong with a thing that was put down at `spot`; None if it stands there.

    Args:
        model: what was put down.
        spot: where, in `map`.
        seen: points (n, 3) in `map` that the depth camera sees now.
        clearance: free height there (metres): what is seen higher is the board above.
    """
    local = Rotation.from_quat(spot.orientation).inv().apply(seen - np.asarray(spot.position))
    low, high = np.subtract(model.lower, _SHIFTED_M)[:2], np.add(model.upper, _SHIFTED_M)[:2]
    over = ((local[:, :2] > low) & (local[:, :2] < high)).all(axis=1)
    highest = min(max(model.size) + _SHIFTED_M, clearance - FLAT_M)
    heights = local[over & (local[:, 2] > FLAT_M) & (local[:, 2] < highest), 2]
    if len(heights) < _FEW_POINTS:
        return None if model.size[2] < 2 * FLAT_M else "is not where I put it"
    if abs(float(np.quantile(heights, 0.99)) - model.size[2]) > _UPRIGHT_M + 0.1 * model.size[2]:
        return "fell over"
    return None


def _outline(model: ObjectModel, turn: float) -> tuple[Floats, Floats]:
    """Lower and upper corner of the turned thing's outline (metres)."""
    corners = np.array([(x, y) for x in _ends(model, 0) for y in _ends(model, 1)])
    cos, sin = np.cos(turn), np.sin(turn)
    turned = corners @ np.array([[cos, sin], [-sin, cos]])
    return turned.min(axis=0), turned.max(axis=0)


def _ends(model: ObjectModel, axis: int) -> tuple[float, float]:
    return model.lower[axis], model.upper[axis]


def _places(surface: Surface) -> Iterator[tuple[float, float]]:
    """How far behind the front row and how far from the middle of the surface (metres).

    In the front row from the middle to both sides; behind it from the sides, which leaves more room
    for what comes later.
    """
    across = list(_from_middle(surface))
    yield from product((0.0,), across)
    behind: list[float] = np.arange(_ROW_M, surface.length_x - RIM_M, _ROW_M).tolist()
    yield from product(behind, across[::-1])


def _has_room(rising: Floats, low: Floats, high: Floats, clear: float) -> bool:
    """Whether hardly anything rises between two corners or this near to them."""
    inside = ((rising > low - clear) & (rising < high + clear)).all(axis=1)
    return bool(inside.sum() < _FEW_POINTS)


def _is_seen(level: Floats, low: Floats, high: Floats) -> bool:
    """Whether the surface is seen nearly everywhere between two corners."""
    cells = np.ceil((high - low) / _CELL_M)
    found = np.floor((level - low) / _CELL_M)
    inside = ((found >= 0) & (found < cells)).all(axis=1)
    return len(np.unique(found[inside], axis=0)) >= _SEEN * float(cells.prod())


def _fits_behind(surface: Surface, back: float) -> bool:
    """Whether what reaches back to there is over the surface, with some margin."""
    return back > MARGIN_M - surface.length_x / 2


def _from_middle(surface: Surface) -> Iterator[float]:
    """Places along the front, from the middle to both sides."""
    for step in range(int(surface.length_y / 2 / _STEP_M) + 1):
        yield from sorted({step * _STEP_M, -step * _STEP_M})


def _fits(surface: Surface, right: float, left: float) -> bool:
    """Whether what reaches from `right` to `left` is over the surface, with some margin."""
    half = surface.length_y / 2 - MARGIN_M
    return right > -half and left < half


def _pose(piece: Furniture, point: tuple[float, float, float], turn: float) -> Pose:
    yaw = piece.pose[2] + turn
    return Pose(piece.to_map(point), heading(yaw))
