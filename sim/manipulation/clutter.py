"""What the depth camera sees standing on a piece of furniture."""

from dataclasses import dataclass

import numpy as np

from executive.geometry import Floats
from sim.home.furniture import Furniture, Surface

CELL_M = 0.03
_ABOVE_M = 0.01
"""Lower than this above a surface, what is seen is the surface."""
_EDGE_M = 0.02
"""Nearer than this to the edge of a surface, it may be what is behind."""
_FEW_POINTS = 2


@dataclass(frozen=True, slots=True)
class Column:
    """A square column in which something stands: middle (x, y), foot and top in `map` (metres)."""

    x: float
    y: float
    foot: float
    top: float


def over(piece: Furniture, seen: Floats) -> Floats:
    """Which of the points (n, 3) in `map` are over a piece of furniture, at whatever height."""
    half = np.array(piece.size[:2]) / 2 - _EDGE_M
    points: Floats = seen[(np.abs(_from_furniture(piece, seen)[:, :2]) < half).all(axis=1)]
    return points


def rising_points(piece: Furniture, surface: Surface, seen: Floats) -> Floats:
    """What of the points (n, 3) in `map` rises above the surface.

    In a frame at the middle of the surface, with the furniture's axes (metres).
    """
    local = _over_surface(piece, surface, seen)
    height = local[:, 2]
    return local[(height > _ABOVE_M) & (height < surface.clearance - _ABOVE_M)]


def level_points(piece: Furniture, surface: Surface, seen: Floats) -> Floats:
    """What of the points (n, 3) in `map` is the surface itself, in the same frame."""
    local = _over_surface(piece, surface, seen)
    return local[np.abs(local[:, 2]) < _ABOVE_M]


def _over_surface(piece: Furniture, surface: Surface, seen: Floats) -> Floats:
    local = _from_furniture(piece, seen) - surface.center
    half = np.array([surface.length_x / 2, surface.length_y / 2]) - _EDGE_M
    over: Floats = local[(np.abs(local[:, :2]) < half).all(axis=1)]
    return over


def columns(piece: Furniture, seen: Floats) -> list[Column]:
    """Everything that stands on a piece of furniture, as columns up to the highest point seen."""
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
    """Points (n, 3) of `map` in the frame of the furniture."""
    x, y, yaw = piece.pose
    cos, sin = np.cos(yaw), np.sin(yaw)
    back = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    local: Floats = (points - (x, y, 0.0)) @ back
    return local
