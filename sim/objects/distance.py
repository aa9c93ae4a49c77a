"""Signed distance, and its gradient, from many points to the surface of an object of shapes."""

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from executive.computing import still_wanted
from executive.geometry import Floats, matrix_of
from executive.records import Shape

Numbers = NDArray[np.floating[Any]]
_AT_ONCE = 8_000
"""Points times shapes that are computed together, so that the arrays fit into the CPU's cache."""
_TINY = 1e-12
_KEPT = 256
"""Size of the cache of `distance_to`; an object has up to six resting poses."""


class SignedDistance:
    """The signed distance to the union of shapes (metres); negative inside.

    Points are columns of arrays (3, n), in the frame of the shapes.
    """

    def __init__(self, shapes: Sequence[Shape]) -> None:
        """Prepare the shapes, sorted by kind."""
        ordered = sorted(shapes, key=lambda shape: shape.kind)
        self._turns = np.stack([matrix_of(s.pose.orientation).T for s in ordered])
        middles = np.array([shape.pose.position for shape in ordered])
        self._axes = self._turns.reshape(-1, 3)
        self._shift = np.einsum("sij,sj->si", self._turns, middles).reshape(-1, 1)
        self._half = np.array([shape.size for shape in ordered])[:, :, None] / 2
        kinds = [shape.kind for shape in ordered]
        self._parts = tuple(_parts(kinds))
        exactly = self._axes, self._shift, self._half
        self._roughly = tuple(numbers.astype(np.float32) for numbers in exactly)

    def at(self, points: Floats) -> Floats:
        """The distance (n,) of each point."""
        pieces = self._in_pieces(points, self._axes, self._shift, self._half)
        return np.concatenate([distances.min(axis=0) for distances in pieces])

    def with_gradient(self, points: Floats) -> tuple[Floats, Floats]:
        """The distances (n,) of points, and their gradients (3, n), which are unit vectors.

        Where the gradient is not unique, as at an edge or a centre, it is one of the possible ones.
        Among shapes whose distances differ by a few nanometres, any can count as the nearest.
        """
        pieces = self._in_pieces(points.astype(np.float32), *self._roughly)
        nearest = np.concatenate([distances.argmin(axis=0) for distances in pieces])
        turns = self._turns[nearest]
        local = np.einsum("nij,jn->in", turns, points) - self._shift.reshape(-1, 3)[nearest].T
        half = self._half[nearest, :, 0].T
        distances, grows = np.empty(points.shape[1]), np.empty(points.shape)
        for kind, of_kind in self._by_kind(nearest):
            found = _WITH_GRADIENTS[kind](local[:, of_kind], half[:, of_kind])
            distances[of_kind], grows[:, of_kind] = found
        return distances, np.einsum("nij,in->jn", turns, grows)

    def _in_pieces(
        self, points: Numbers, axes: Numbers, shift: Numbers, half: Numbers
    ) -> Iterator[Numbers]:
        """Distances (shapes, n) in batches of points."""
        count = max(1, _AT_ONCE // len(half))
        for start in range(0, max(1, points.shape[1]), count):
            still_wanted()
            local = (axes @ points[:, start : start + count] - shift).reshape(len(half), 3, -1)
            parts = [_DISTANCES[kind](local[part], half[part]) for kind, part in self._parts]
            yield parts[0] if len(parts) == 1 else np.concatenate(parts)

    def _by_kind(self, nearest: NDArray[np.intp]) -> Iterator[tuple[str, slice | NDArray[np.intp]]]:
        """Each kind of shape, with the indices of the points whose nearest shape is of it."""
        if len(self._parts) == 1:
            yield self._parts[0][0], slice(None)
            return
        for kind, part in self._parts:
            yield kind, np.flatnonzero((nearest >= part.start) & (nearest < part.stop))


@lru_cache(maxsize=_KEPT)
def distance_to(shapes: tuple[Shape, ...]) -> SignedDistance:
    """The signed distance to these shapes, cached."""
    return SignedDistance(shapes)


def _parts(kinds: Sequence[str]) -> Iterator[tuple[str, slice]]:
    """Each kind that occurs, and its slice of the sorted kinds."""
    for kind in sorted(set(kinds)):
        first = kinds.index(kind)
        yield kind, slice(first, first + kinds.count(kind))


# --- distances (s, n) of points (s, 3, n) to shapes of half lengths (s, 3, 1) ---


def _to_boxes(local: Floats, half: Floats) -> Floats:
    beyond = np.abs(local)
    beyond -= half
    inside = np.minimum(np.maximum(np.maximum(beyond[:, 0], beyond[:, 1]), beyond[:, 2]), 0.0)
    np.maximum(beyond, 0.0, out=beyond)
    beyond *= beyond
    outside: Floats = np.sqrt(beyond[:, 0] + beyond[:, 1] + beyond[:, 2])
    outside += inside
    return outside


def _to_cylinders(local: Floats, half: Floats) -> Floats:
    radial = np.sqrt(local[:, 0] ** 2 + local[:, 1] ** 2) - half[:, 0]
    along = np.abs(local[:, 2]) - half[:, 2]
    outside: Floats = np.sqrt(np.maximum(radial, 0.0) ** 2 + np.maximum(along, 0.0) ** 2)
    outside += np.minimum(np.maximum(radial, along), 0.0)
    return outside


def _to_spheres(local: Floats, half: Floats) -> Floats:
    away: Floats = np.sqrt(local[:, 0] ** 2 + local[:, 1] ** 2 + local[:, 2] ** 2) - half[:, 0]
    return away


# --- distances (n,) of points (3, n) to shapes of half lengths (3, n), and gradients (3, n) ---


def _from_box(local: Floats, half: Floats) -> tuple[Floats, Floats]:
    beyond = np.abs(local) - half
    deepest = beyond.max(axis=0)
    grows = np.maximum(beyond, 0.0)
    distances = np.sqrt(grows[0] ** 2 + grows[1] ** 2 + grows[2] ** 2)
    grows /= np.maximum(distances, _TINY)
    within = np.flatnonzero(deepest <= 0.0)
    grows[beyond[:, within].argmax(axis=0), within] = 1.0
    return distances + np.minimum(deepest, 0.0), np.copysign(grows, local)


def _from_cylinder(local: Floats, half: Floats) -> tuple[Floats, Floats]:
    around = np.sqrt(local[0] ** 2 + local[1] ** 2)
    radial, along = around - half[0], np.abs(local[2]) - half[2]
    out, up = np.maximum(radial, 0.0), np.maximum(along, 0.0)
    distances = np.sqrt(out**2 + up**2)
    within = distances == 0.0
    out[within & (radial >= along)] = up[within & (radial < along)] = 1.0
    scale = np.maximum(np.sqrt(out**2 + up**2), _TINY)
    out /= scale * np.maximum(around, _TINY)
    grows = np.stack((out * local[0], out * local[1], np.copysign(up / scale, local[2])))
    return distances + np.minimum(np.maximum(radial, along), 0.0), grows


def _from_sphere(local: Floats, half: Floats) -> tuple[Floats, Floats]:
    away = np.sqrt(local[0] ** 2 + local[1] ** 2 + local[2] ** 2)
    return away - half[0], local / np.maximum(away, _TINY)


_Function = Callable[[Any, Any], Any]
_DISTANCES: dict[str, _Function] = {
    "box": _to_boxes,
    "cylinder": _to_cylinders,
    "sphere": _to_spheres,
}
_WITH_GRADIENTS: dict[str, _Function] = {
    "box": _from_box,
    "cylinder": _from_cylinder,
    "sphere": _from_sphere,
}
