"""Signed distance to, and points on, the surface of a union of boxes, cylinders and spheres."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from executive.geometry import Floats, transform, turned
from executive.records import Shape
from sim.objects.distance import distance_to

_KEPT = 256
"""Size of the cache of surfaces."""


def signed_distance(shapes: Sequence[Shape], points: Floats) -> Floats:
    """(n,) signed distance of points (n, 3) to the union of shapes; negative inside (metres)."""
    return distance_to(tuple(shapes)).at(points.T)


@lru_cache(maxsize=_KEPT)
def _surface(shapes: tuple[Shape, ...], spacing: float) -> tuple[Floats, Floats]:
    found_points, found_normals = [], []
    for shape in shapes:
        points, normals = _SAMPLERS[shape.kind](np.asarray(shape.size), spacing)
        found_points.append(transform(shape.pose, points))
        found_normals.append(turned(shape.pose.orientation, normals))
    points, normals = np.concatenate(found_points), np.concatenate(found_normals)
    outside = signed_distance(shapes, points) > -spacing / 10
    return points[outside], normals[outside]


def sample_surface(shapes: Sequence[Shape], spacing: float = 0.004) -> tuple[Floats, Floats]:
    """Points (n, 3) on the outer surface, about `spacing` metres apart; unit normals (n, 3)."""
    points, normals = _surface(tuple(shapes), spacing)
    return points.copy(), normals.copy()


def _steps(length: float, spacing: float) -> Floats:
    count = max(2, round(length / spacing))
    return (np.arange(count) + 0.5) / count * length - length / 2


def _on_box(size: Floats, spacing: float) -> tuple[Floats, Floats]:
    points, normals = [], []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        grid = np.stack(np.meshgrid(_steps(size[u], spacing), _steps(size[v], spacing)), axis=-1)
        for side in (-1.0, 1.0):
            face = np.empty((grid.shape[0] * grid.shape[1], 3))
            face[:, (u, v)] = grid.reshape(-1, 2)
            face[:, axis] = side * size[axis] / 2
            points.append(face)
            normals.append(np.broadcast_to(side * np.eye(3)[axis], face.shape))
    return np.concatenate(points), np.concatenate(normals)


def _on_cylinder(size: Floats, spacing: float) -> tuple[Floats, Floats]:
    radius, length = size[0] / 2, size[2]
    turns = np.arange(max(8, round(2 * np.pi * radius / spacing)))
    angles = turns * 2 * np.pi / len(turns)
    around = np.column_stack((np.cos(angles), np.sin(angles), np.zeros(len(angles))))
    heights = _steps(length, spacing)
    side = np.tile(radius * around, (len(heights), 1))
    side[:, 2] = np.repeat(heights, len(angles))
    plane = np.stack(np.meshgrid(_steps(2 * radius, spacing), _steps(2 * radius, spacing)), -1)
    disc = plane.reshape(-1, 2)
    disc = disc[np.linalg.norm(disc, axis=1) < radius]
    caps = [np.column_stack((disc, np.full(len(disc), end))) for end in (-length / 2, length / 2)]
    up = np.array([0.0, 0.0, 1.0])
    normals = [np.tile(around, (len(heights), 1)), np.tile(-up, (len(disc), 1))]
    return np.concatenate((side, *caps)), np.concatenate((*normals, np.tile(up, (len(disc), 1))))


def _on_sphere(size: Floats, spacing: float) -> tuple[Floats, Floats]:
    """Points of a Fibonacci lattice."""
    radius = size[0] / 2
    index = np.arange(max(50, round(4 * np.pi * radius**2 / spacing**2))) + 0.5
    z = 1 - 2 * index / len(index)
    angle = np.pi * (1 + np.sqrt(5)) * index
    ring = np.sqrt(1 - z**2)
    normals = np.column_stack((ring * np.cos(angle), ring * np.sin(angle), z))
    return radius * normals, normals


_SAMPLERS = {"box": _on_box, "cylinder": _on_cylinder, "sphere": _on_sphere}
