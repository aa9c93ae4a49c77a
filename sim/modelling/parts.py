"""The parts of a mesh: boxes, prisms, and textured surfaces over rings of points.

A ring is a closed line of points (n, 3). Rings that are stacked upwards run counterclockwise as
seen from above, and begin at the back (-x), so that the centre of a skin faces the front (+x).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL.Image import Image
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation

from executive.geometry import Floats

AROUND = 20
"""Number of points of a round ring."""


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A smooth surface with a texture.

    Attributes:
        points: (n, 3), metres.
        faces: (m, 3) indices of points, counterclockwise as seen from outside.
        uv: (n, 2) texture coordinates of the points: from left and from the bottom, 0 to 1.
        skin: the texture.
    """

    points: Floats
    faces: NDArray[np.int64]
    uv: Floats
    skin: Image

    def moved(self, at: Sequence[float], rpy: Sequence[float] = (0, 0, 0)) -> Self:
        """The part turned by roll, pitch and yaw (degrees), then shifted (metres)."""
        turn = Rotation.from_euler("xyz", rpy, degrees=True)
        return replace(self, points=turn.apply(self.points) + np.asarray(at))


def ring(
    width_x: float, width_y: float, z: float, roundness: float = 1.0, count: int = AROUND
) -> Floats:
    """A horizontal ring around the z axis.

    Args:
        width_x: its extent along x (metres).
        width_y: its extent along y.
        z: its height.
        roundness: 1 for an ellipse, towards 0 for a rectangle (a superellipse of exponent
            2 / roundness).
        count: number of points.
    """
    angles = np.linspace(-np.pi, np.pi, count, endpoint=False)
    if roundness < 1:
        angles = angles + 0.25 * (1 - roundness) * np.sin(4 * angles)
    wave = np.column_stack((np.cos(angles), np.sin(angles)))
    flat = np.sign(wave) * np.abs(wave) ** roundness * (width_x / 2, width_y / 2)
    return np.column_stack((flat, np.full(count, z)))


def loft(rings: Sequence[Floats] | Floats, skin: Image) -> Part:
    """A surface over rings of equally many points; the skin wraps around once, left to right."""
    grid = np.asarray(rings)
    grid = np.concatenate((grid, grid[:, :1]), axis=1)
    rows, columns = grid.shape[:2]
    widest = grid[np.argmax(np.ptp(grid, axis=1).sum(axis=1))]
    u, v = _progress(widest), _progress(grid.mean(axis=1) + grid[:, 0] - grid[:, 0].mean(axis=0))
    uv = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
    corner = np.arange(rows * columns).reshape(rows, columns)
    a, b = corner[:-1, :-1].ravel(), corner[:-1, 1:].ravel()
    c, d = corner[1:, 1:].ravel(), corner[1:, :-1].ravel()
    faces = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    return _part(grid.reshape(-1, 3), faces, uv, skin)


def cap(edge: Floats, skin: Image, up: bool = True) -> Part:
    """A flat lid on a ring, star-shaped around its centre; the skin is upright from the front."""
    points = np.concatenate((edge, [edge.mean(axis=0)]))
    low, extent = edge.min(axis=0), np.ptp(edge, axis=0)
    across = (points - low) / np.where(extent > 0, extent, 1.0)
    uv = np.column_stack((across[:, 1], 1 - across[:, 0]))
    here = np.arange(len(edge))
    there, hub = np.roll(here, -1), np.full(len(edge), len(edge))
    order = (here, there, hub) if up else (there, here, hub)
    return _part(points, np.column_stack(order), uv, skin)


def solid(rings: Sequence[Floats], skin: Image, lid: Image) -> list[Part]:
    """Stacked rings closed by lids below and above."""
    return [loft(rings, skin), cap(rings[0], lid, up=False), cap(rings[-1], lid)]


def lathe(profile: ArrayLike, skin: Image, steps: int = 0, count: int = AROUND) -> Part:
    """The surface of revolution of a profile (n, 2) of (radius, z), from bottom to top.

    With `steps`, the profile is a smooth curve of that many points, else straight lines.
    """
    line = smooth(profile, steps) if steps else np.asarray(profile, dtype=np.float64)
    return loft([ring(2 * r, 2 * r, z, count=count) for r, z in line], skin)


def smooth(points: ArrayLike, steps: int) -> Floats:
    """A curve of `steps` points through given ones (n, k), without overshooting."""
    given = np.asarray(points, dtype=np.float64)
    way = _progress(given)
    return np.asarray(PchipInterpolator(way, given)(np.linspace(0, 1, steps)))


def sphere(diameter: float, skin: Image, rows: int = 12) -> Part:
    """A ball that stands on z = 0; the rows of its skin are at equal angles."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, rows + 1)
    profile = np.column_stack((np.cos(angles), 1 + np.sin(angles))) * diameter / 2
    return lathe(profile, skin)


def sweep(
    spine: ArrayLike,
    widths: ArrayLike,
    skin: Image,
    roundness: float = 1.0,
    count: int = 12,
    ends: Image | None = None,
) -> list[Part]:
    """A surface around a spine, which lies in a plane of constant x or of constant z.

    Args:
        spine: (n, 3), metres.
        widths: (n, 2) or (2,): extent of the cross-section in the plane, and across it.
        skin: drawn once around and along the spine.
        roundness: see `ring`.
        count: points of each cross-section.
        ends: the skin of flat lids at both ends; None: the spine is closed to a loop.
    """
    line = np.asarray(spine, dtype=np.float64)
    along = (
        np.roll(line, -1, 0) - np.roll(line, 1, 0) if ends is None else np.gradient(line, axis=0)
    )
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.eye(3)[int(np.argmin(np.ptp(line, axis=0)))]
    beside = np.cross(across, along)
    widths = np.broadcast_to(widths, (len(line), 2))
    section = ring(1.0, 1.0, 0.0, roundness, count)[:, :2]
    rings = [
        middle + np.outer(section[:, 0] * w, aside) + np.outer(section[:, 1] * h, across)
        for middle, aside, (w, h) in zip(line, beside, widths, strict=True)
    ]
    if ends is None:
        return [loft([*rings, rings[0]], skin)]
    return solid(rings, skin, ends)


def prism(outline: ArrayLike, low: float, high: float, side: Image, top: Image) -> list[Part]:
    """A prism from z = `low` to `high`; its outline (n, 2) is counterclockwise and star-shaped."""
    flat = np.asarray(outline, dtype=np.float64)
    below, above = (np.column_stack((flat, np.full(len(flat), z))) for z in (low, high))
    walls = [
        _quad(np.array([below[i], below[j], above[j], above[i]]), side)
        for i, j in ((i, (i + 1) % len(flat)) for i in range(len(flat)))
    ]
    return [*walls, cap(below, top, up=False), cap(above, top)]


def box(size: ArrayLike, at: ArrayLike, *skins: Image) -> list[Part]:
    """A box with skins for front and back, left and right, top and bottom; or one for all."""
    front, side, top = skins if len(skins) == 3 else skins * 3
    middle = np.asarray(at, dtype=np.float64)
    x, y, z = np.diag(np.asarray(size, dtype=np.float64) / 2)
    sides = (
        (x, y, z, front),
        (-x, -y, z, front),
        (y, -x, z, side),
        (-y, x, z, side),
        (z, y, -x, top),
        (-z, y, x, top),
    )
    return [
        _quad(np.array([middle + n + a * right + b * up for a, b in _CORNERS]), skin)
        for n, right, up, skin in sides
    ]


_CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))


def _quad(corners: Floats, skin: Image) -> Part:
    uv = (np.array(_CORNERS) + 1) / 2
    return _part(corners, np.array([[0, 1, 2], [0, 2, 3]]), uv, skin)


def _part(points: Floats, faces: NDArray[np.int64], uv: Floats, skin: Image) -> Part:
    """The part without triangles of zero area."""
    corners = points[faces]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return Part(points, faces[area > 1e-12], uv, skin)


def _progress(line: Floats) -> Floats:
    """(n,) the relative length of an open line (n, k) up to each point, 0 to 1."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    way = np.concatenate(([0.0], np.cumsum(steps)))
    return np.asarray(way / way[-1])
