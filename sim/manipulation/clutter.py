"""Finds objects on furniture in the points of the depth camera."""

from dataclasses import dataclass

import numpy as np

from executive.geometry import Floats
from sim.home.furniture import Furniture, Surface

CELL_M = 0.03
_ABOVE_M = 0.01
"""Points lower than this above a surface belong to the surface."""
_EDGE_M = 0.02
"""Points nearer than this to the edge of a surface are ignored: they may be of something behind."""
_FEW_POINTS = 2
"""Fewer points than this in a column are noise."""


@dataclass(frozen=True, slots=True)
class Column:
    """An occupied square column: centre (x, y), foot and top in `map` (metres)."""

    x: float
    y: float
    foot: float
    top: float


def over(piece: Furniture, seen: Floats) -> Floats:
    """The points (m, 3), of points (n, 3) in `map`, over a piece of furniture at any height."""
    half = np.array(piece.size[:2]) / 2 - _EDGE_M
    points: Floats = seen[(np.abs(_from_furniture(piece, seen)[:, :2]) < half).all(axis=1)]
    return points


def rising_points(piece: Furniture, surface: Surface, seen: Floats) -> Floats:
    """The points (m, 3), of points (n, 3) in `map`, above a surface and below the next board.

    They are in a frame at the centre of the surface, with the furniture's axes (metres).
    """
    local = _over_surface(piece, surface, seen)
    height = local[:, 2]
    return local[(height > _ABOVE_M) & (height < surface.clearance - _ABOVE_M)]


def level_points(piece: Furniture, surface: Surface, seen: Floats) -> Floats:
    """The points (m, 3), of points (n, 3) in `map`, of the surface itself, in the same frame."""
    local = _over_surface(piece, surface, seen)
    return local[np.abs(local[:, 2]) < _ABOVE_M]


def _over_surface(piece: Furniture, surface: Surface, seen: Floats) -> Floats:
    local = _from_furniture(piece, seen) - surface.center
    half = np.array([surface.length_x / 2, surface.length_y / 2]) - _EDGE_M
    over: Floats = local[(np.abs(local[:, :2]) < half).all(axis=1)]
    return over


def columns(piece: Furniture, seen: Floats) -> list[Column]:
    """All that stands on a piece of furniture, as columns up to the highest visible point."""
    found = []
    for surface in piece.surfaces():
        points = rising_points(piece, surface, seen)
        cells = np.floor(points[:, :2] / CELL_M).astype(int)
        for cell in np.unique(cells, axis=0):
            heights = points[(cells == cell).all(axis=1), 2]
            if len(heights) >= _FEW_POINTS:
                dx, dy = (cell + 0.5) * CELL_M + surface.center[:2]
                x, y, foot = piece.to_map((dx, dy, surface.center[2]))
                found.append(Column(x, y, foot, foot + float(heights.max())))
    return found


def _from_furniture(piece: Furniture, points: Floats) -> Floats:
    """Transform points (n, 3) from `map` to the furniture frame."""
    x, y, yaw = piece.pose
    cos, sin = np.cos(yaw), np.sin(yaw)
    back = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    local: Floats = (points - (x, y, 0.0)) @ back
    return local
