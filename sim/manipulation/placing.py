"""Finds free spots on furniture for a held object, and checks an object that was put down."""

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
"""Distance from the front edge of a surface to the centre of an object, for the arm's reach."""
MARGIN_M = 0.02
"""Least distance from the outline of an object to the edge of its surface."""
CLEAR_M = 0.06
"""Free space around the outline of an object, for the fingers."""
TIGHT_M = 0.04
"""The same where there is no better spot."""
HEADROOM_M = 0.05
"""Free height above an object under a board."""
DROP_M = 0.002
"""The height above the surface at which an object is released."""
_SHIFTED_M = 0.03
"""An object can slide this far when it is released."""
FLAT_M = 0.012
"""The camera cannot tell lower objects from the surface."""
_UPRIGHT_M = 0.015
"""The height of a standing object differs from its model by at most this and a tenth of it."""
_STEP_M, _ROW_M = 0.04, 0.08
"""Distance between spots along the front, and between rows of spots (metres)."""
_CELL_M, _SEEN = 0.05, 0.8
"""Behind the front row, the camera must see this fraction of a spot's cells: objects in front may
hide others."""
_FEW_POINTS = 3
"""Fewer points than this are noise."""
_TURNS = (0.0, np.pi, np.pi / 2, -np.pi / 2)


def free_spots(
    piece: Furniture, surface: Surface, model: ObjectModel, seen: Floats, turn: float = 0.0
) -> Iterator[Pose]:
    """Poses in `map` on a surface where an object can stand, the easiest to reach first.

    Args:
        piece: the furniture, from the map.
        surface: one of its surfaces.
        model: the object to put down.
        seen: points (n, 3) in `map` that the depth camera sees now; those above the surface are
            obstacles.
        turn: the preferred yaw of the object in the furniture frame (radians); the other quarter
            turns from it are tried, too.
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
    """Check an object that was put down at `spot`; None if it stands there, else what is wrong.

    Args:
        model: the object.
        spot: its intended pose in `map`.
        seen: points (n, 3) in `map` that the depth camera sees now.
        clearance: free height there (metres); higher points belong to the board above.
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
    """Lower and upper corner (2,) of the outline of an object with the yaw `turn` (metres)."""
    corners = np.array([(x, y) for x in _ends(model, 0) for y in _ends(model, 1)])
    cos, sin = np.cos(turn), np.sin(turn)
    turned = corners @ np.array([[cos, sin], [-sin, cos]])
    return turned.min(axis=0), turned.max(axis=0)


def _ends(model: ObjectModel, axis: int) -> tuple[float, float]:
    return model.lower[axis], model.upper[axis]


def _places(surface: Surface) -> Iterator[tuple[float, float]]:
    """Positions to try: distance behind the front row, and y on the surface (metres).

    The front row goes from the centre to both sides. The rows behind it begin at the sides, which
    leaves more room for later objects.
    """
    across = list(_from_middle(surface))
    yield from product((0.0,), across)
    behind: list[float] = np.arange(_ROW_M, surface.length_x - RIM_M, _ROW_M).tolist()
    yield from product(behind, across[::-1])


def _has_room(rising: Floats, low: Floats, high: Floats, clear: float) -> bool:
    """Whether (almost) no points are between two corners, or nearer to them than `clear`."""
    inside = ((rising > low - clear) & (rising < high + clear)).all(axis=1)
    return bool(inside.sum() < _FEW_POINTS)


def _is_seen(level: Floats, low: Floats, high: Floats) -> bool:
    """Whether the camera sees the surface nearly everywhere between two corners."""
    cells = np.ceil((high - low) / _CELL_M)
    found = np.floor((level - low) / _CELL_M)
    inside = ((found >= 0) & (found < cells)).all(axis=1)
    return len(np.unique(found[inside], axis=0)) >= _SEEN * float(cells.prod())


def _fits_behind(surface: Surface, back: float) -> bool:
    """Whether an outline that reaches back to x = `back` is on the surface, with a margin."""
    return back > MARGIN_M - surface.length_x / 2


def _from_middle(surface: Surface) -> Iterator[float]:
    """Positions y along the front, from the centre to both sides."""
    for step in range(int(surface.length_y / 2 / _STEP_M) + 1):
        yield from sorted({step * _STEP_M, -step * _STEP_M})


def _fits(surface: Surface, right: float, left: float) -> bool:
    """Whether an outline from y = `right` to `left` is on the surface, with a margin."""
    half = surface.length_y / 2 - MARGIN_M
    return right > -half and left < half


def _pose(piece: Furniture, point: tuple[float, float, float], turn: float) -> Pose:
    yaw = piece.pose[2] + turn
    return Pose(piece.to_map(point), heading(yaw))
