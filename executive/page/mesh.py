"""The triangles of a thing, with their colours: from its OBJ file, or from its plain shapes."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from executive.files import read_text
from executive.records import Shape
from sim.objects.objects import ObjectModel

Floats = NDArray[np.float64]
MOST_BYTES = 64 * 2**20
AROUND = 32
"""Corners of a circle."""


@dataclass(frozen=True)
class Mesh:
    """Triangles and their colours.

    Attributes:
        corners: (n, 3, 3) metres, in the object frame.
        at: (n, 3, 2) where in the texture each corner is, from its lower left corner, in [0, 1].
        texture: (height, width, 3) uint8.
    """

    corners: Floats
    at: Floats
    texture: NDArray[np.uint8]


def meshes(model: ObjectModel) -> list[Mesh]:
    """What a thing looks like.

    Raises:
        InputError: if its file is not there any more.
        ValueError: if it is no OBJ; or an OSError, if its texture is no picture.
    """
    shapes = model.shapes if model.look is None else (model.look,)
    return [mesh_of(shape) for shape in shapes]


def mesh_of(shape: Shape) -> Mesh:
    """One shape of a thing."""
    if shape.kind == "mesh":
        return _read(Path(shape.mesh), partial(_placed, shape))
    hull = ConvexHull(_points(shape.kind))
    corners = _placed(shape, hull.points[hull.simplices])
    texture = np.array([[shape.color[:3]]]) * 255
    return Mesh(corners, np.zeros((len(corners), 3, 2)), texture.astype(np.uint8))


def _placed(shape: Shape, points: Floats) -> Floats:
    turn = Rotation.from_quat(shape.pose.orientation)
    scaled = points * np.asarray(shape.size)
    turned: Floats = turn.apply(scaled.reshape(-1, 3)).reshape(scaled.shape)
    moved: Floats = turned + np.asarray(shape.pose.position)
    return moved


def _points(kind: str) -> Floats:
    """The corners of a shape of size 1."""
    if kind == "box":
        return np.array(np.meshgrid(*[[-0.5, 0.5]] * 3)).reshape(3, -1).T
    angle = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1) / 2
    if kind == "cylinder":
        return np.array([[x, y, z] for x, y in circle for z in (-0.5, 0.5)])
    turns = np.linspace(0, np.pi, AROUND // 2)
    rings = [(np.sin(t), np.cos(t) / 2) for t in turns]
    return np.array([[x * wide, y * wide, z] for wide, z in rings for x, y in circle])


def _read(path: Path, placed: "partial[Floats]") -> Mesh:
    """Points, texture and triangles of an OBJ file; of larger faces, fans."""
    lines = [line.split() for line in read_text(path, most=MOST_BYTES).splitlines()]
    points = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=np.float64)
    known = [line[1:3] for line in lines if line[:1] == ["vt"]]
    spots = np.array(known or [["0", "0"]], dtype=np.float64)
    triangles = [
        [_numbers(corner) for corner in (first, second, third)]
        for _, first, *others in (line for line in lines if line[:1] == ["f"])
        for second, third in zip(others, others[1:], strict=False)
    ]
    chosen = np.array(triangles, dtype=np.int64)
    return Mesh(placed(points[chosen[..., 0]]), spots[chosen[..., 1]], _texture(path, lines))


def _numbers(corner: str) -> tuple[int, int]:
    """Point and spot in the texture, counted from 0."""
    point, _, rest = corner.partition("/")
    spot = rest.partition("/")[0]
    return int(point) - 1, int(spot) - 1 if spot else 0


def _texture(path: Path, lines: list[list[str]]) -> NDArray[np.uint8]:
    """The picture that its material names; without one, light grey."""
    for material in (line[1] for line in lines if line[:1] == ["mtllib"]):
        described = path.parent / Path(material).name
        for said in read_text(described).splitlines():
            key, _, name = said.strip().partition(" ")
            if key == "map_Kd":
                with Image.open(path.parent / Path(name.strip()).name) as picture:
                    return np.asarray(picture.convert("RGB"), dtype=np.uint8)
    return np.full((1, 1, 3), 200, dtype=np.uint8)
