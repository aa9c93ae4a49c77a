"""Checks meshes that others made of an object, and aligns them with the object's own shapes.

A mesh has a frame of its own. It is rotated so that its points come nearest to the surface of our
shapes, scaled uniformly so that its bounding box has the volume of ours, and placed with the centre
of its base on ours. Collisions still use the shapes.
"""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.spatial import ConvexHull, QhullError
from scipy.spatial.transform import Rotation

from executive.colors import Color
from executive.errors import InputError
from executive.files import read_bytes
from executive.geometry import Floats
from executive.records import Shape
from executive.types.geometry import Pose
from sim.objects.objects import WHITE, ObjectModel
from sim.objects.solids import signed_distance

MOST_BYTES = 64 * 2**20
"""Size limit of a mesh or a texture; the largest google_16k files of YCB have a tenth of that."""
LARGEST_PICTURE = 8192
LONGEST_LINE = 1000
_PICTURES = ("map_Kd", "map_Ka", "map_Ks", "map_Ns", "map_d", "map_bump", "map_Bump", "bump")
"""Keys in a material file that name picture files."""
_POINTS = 300
_RIGHT_ANGLES = Rotation.create_group("O")
_COARSE, _FINE = np.arange(0.0, 90.0, 10.0), np.arange(-9.0, 10.0)
"""Yaws (degrees) that are tried with each right-angle rotation, and around the best of these."""
_STANDING_M = 0.001
"""A scan is laid on another side only if its mean distance to our shapes is smaller by this."""


def aligned(model: ObjectModel, path: Path, color: Color = WHITE) -> Shape:
    """Read an OBJ file, and return its mesh aligned with the model, in the object's frame.

    Raises:
        InputError: if the file, its material or its texture cannot be used.
    """
    points = _read(path)
    corners = points[ConvexHull(points).vertices]
    few = points[:: max(1, len(points) // _POINTS)]

    def misfit(turn: Rotation) -> float:
        scale, pose = _fitted(model, corners, turn)
        placed = turn.apply(scale * few) + pose.position
        return float(np.abs(signed_distance(model.shapes, placed)).mean())

    def best(rights: Iterable[Rotation]) -> Rotation:
        coarse = min((right * _yaw(angle) for right in rights for angle in _COARSE), key=misfit)
        return min((coarse * _yaw(angle) for angle in _FINE), key=misfit)

    standing, lying = (
        best(right for right in _RIGHT_ANGLES if (right.as_matrix()[2, 2] > 0.5) == upright)
        for upright in (True, False)
    )
    turn = lying if misfit(lying) < misfit(standing) - _STANDING_M else standing
    scale, pose = _fitted(model, corners, turn)
    return Shape("mesh", (scale,) * 3, color, pose, str(path.absolute()))


def _yaw(degrees: float) -> Rotation:
    return Rotation.from_euler("z", degrees, degrees=True)


def _fitted(model: ObjectModel, corners: Floats, turn: Rotation) -> tuple[float, Pose]:
    """The scale, and the pose with rotation `turn`, that bring points onto the object's base."""
    turned = turn.apply(corners)
    low, high = turned.min(axis=0), turned.max(axis=0)
    scale = float((np.prod(model.size) / np.prod(high - low)) ** (1 / 3))
    ours = (np.array(model.lower) + model.upper) / 2
    shift = ours - scale * (low + high) / 2
    shift[2] = model.lower[2] - scale * low[2]
    return scale, Pose(tuple(shift.tolist()), tuple(turn.as_quat().tolist()))


def _read(path: Path) -> Floats:
    """The points (n, 3) of an OBJ file, after checks that PyBullet can draw it.

    Raises:
        InputError: if the file, its material or its texture cannot be used.
    """
    text = _text(path)
    try:
        points, corners = _points_and_corners(text)
    except ValueError:
        raise InputError(str(path), "has points or faces that are no OBJ") from None
    if not corners or min(corners) < 1 or max(corners) > len(points):
        fault = "has no faces, or faces of points that it does not have"
        raise InputError(str(path), fault, "export it anew, with its faces")
    try:
        ConvexHull(points)
    except (QhullError, ValueError):
        raise InputError(str(path), "has points that enclose no volume") from None
    for material in _lines(text, "mtllib"):
        described = _beside(path, material)
        content = _text(described, f"put it there, or take the line mtllib out of {path.name}")
        for key in _PICTURES:
            for texture in _lines(content, key):
                _check_picture(described, _beside(described, texture))
    return points


def _points_and_corners(text: str) -> tuple[Floats, set[int]]:
    """The points (n, 3), and the numbers (from 1) of the points that faces use.

    A face can also count back from the last point before it, which is -1.

    Raises:
        ValueError: if a number cannot be parsed.
    """
    points, corners = list[list[str]](), set[int]()
    for line in text.splitlines():
        key, *parts = line.split() or [""]
        if key == "v":
            points.append(parts[:3])
        elif key == "f":
            numbers = [int(corner.split("/")[0]) for corner in parts]
            corners |= {n + len(points) + 1 if n < 0 else n for n in numbers}
    return np.array(points, dtype=np.float64), corners


def _beside(file: Path, line: str) -> Path:
    """The path of the file that a line names, which must be in the same folder.

    Raises:
        InputError: if it is in another folder.
    """
    named = line.split(maxsplit=1)[1]
    there = file.parent / named
    if Path(named).name != named or there.resolve().parent != file.parent.resolve():
        right = "put it into the same folder"
        raise InputError(str(file), f"names a file that is elsewhere: {named[:80]}", right)
    return there


def _check_picture(described: Path, picture: Path) -> None:
    """Check by its header that a texture is a picture of acceptable size.

    Raises:
        InputError: if it is not.
    """
    if not picture.is_file():
        raise InputError(str(described), f"names a texture that is not there: {picture.name}")
    read_bytes(picture, MOST_BYTES)
    try:
        with Image.open(picture) as opened:
            largest = max(opened.size)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        raise InputError(str(picture), "is not a picture", "give PNG or JPEG") from None
    if largest > LARGEST_PICTURE:
        right = f"give up to {LARGEST_PICTURE} pixels a side"
        raise InputError(str(picture), f"is {largest} pixels long", right)


def _text(path: Path, right: str = "") -> str:
    """The text of a mesh or material file; PyBullet cannot read lines over LONGEST_LINE.

    Raises:
        InputError: if the file cannot be read, or has a longer line.
    """
    text = read_bytes(path, MOST_BYTES, right=right).decode("utf-8", errors="replace")
    if max(map(len, text.splitlines()), default=0) > LONGEST_LINE:
        raise InputError(str(path), f"has a line of more than {LONGEST_LINE} characters")
    return text


def _lines(text: str, key: str) -> list[str]:
    """The lines that begin with a key."""
    return [line.strip() for line in text.splitlines() if line.split(maxsplit=1)[:1] == [key]]
