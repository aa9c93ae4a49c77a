"""Pictures of things for the answers that a person may choose from: drawn from what they look like.

It is the mesh that the simulated home has, or somebody's own: the thing as it is, and no symbol.
"""

import io
import logging
import threading
from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial.transform import Rotation

from executive.guards import in_words
from executive.page.mesh import Floats, Mesh, meshes
from sim.objects.objects import ObjectModel

SIDE = 160
"""Pixels of a picture; it is drawn twice as large."""
MARGIN = 0.06
VIEW = Rotation.from_euler("zx", [-35, -65], degrees=True)
"""From the front, a little from the right and from above, as things are looked at on a table."""
LIGHT = np.array([-0.35, 0.5, 0.8]) / np.linalg.norm([-0.35, 0.5, 0.8])
DARKEST = 0.55

log = logging.getLogger(__name__)


class Portraits:
    """A PNG for each thing, drawn when it is asked for first. For any thread."""

    def __init__(self, models: Mapping[str, ObjectModel]) -> None:
        """Know these things."""
        self._models = dict(models)
        self._drawn: dict[str, bytes | None] = {}
        self._lock = threading.Lock()

    def names(self) -> tuple[str, ...]:
        """The things that there is a picture of."""
        return tuple(self._models)

    def png(self, name: str) -> bytes | None:
        """Its picture; None if there is none."""
        with self._lock:
            if name not in self._drawn and name in self._models:
                self._drawn[name] = _drawn(partial(portrait, self._models[name]))
            return self._drawn.get(name)


def _drawn(draw: Callable[[], bytes]) -> bytes | None:
    try:
        return draw()
    except Exception as error:  # a file of somebody's own that is no OBJ any more
        log.warning("a thing cannot be drawn: %s", in_words(error))
        return None


def portrait(model: ObjectModel, side: int = SIDE) -> bytes:
    """A thing on a transparent ground, as PNG.

    Raises:
        InputError: or OSError, or ValueError, if its files are not what they say.
    """
    large = 2 * side
    seen = [
        (mesh, VIEW.apply(mesh.corners.reshape(-1, 3)).reshape(-1, 3, 3)) for mesh in meshes(model)
    ]
    points = np.concatenate([corners.reshape(-1, 3) for _, corners in seen])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = large * (1 - 2 * MARGIN) / max(high[0] - low[0], high[1] - low[1], 1e-6)
    middle = (low + high) / 2
    picture = np.zeros((large, large, 4), dtype=np.uint8)
    depth = np.full((large, large), -np.inf)
    for mesh, corners in seen:
        flat = (corners - middle) * scale * (1, -1, 1) + (large / 2, large / 2, 0)
        _draw(mesh, corners, flat, picture, depth)
    small = Image.fromarray(picture, "RGBA").resize((side, side), Image.Resampling.LANCZOS)
    file = io.BytesIO()
    small.save(file, "PNG")
    return file.getvalue()


def _draw(
    mesh: Mesh, seen: Floats, flat: Floats, picture: NDArray[np.uint8], depth: Floats
) -> None:
    """Draw triangles, the nearest in front; `flat` has pixels and, towards the eye, the depth."""
    normals = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    lengths = np.maximum(np.linalg.norm(normals, axis=1), 1e-12)
    bright = DARKEST + (1 - DARKEST) * np.abs(normals @ LIGHT) / lengths
    rows, columns, _ = mesh.texture.shape
    for one in np.argsort(-flat[:, :, 2].max(axis=1)):  # the nearest first hides the others
        (a, b, c), spots, light = flat[one], mesh.at[one], bright[one]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if abs(area) < 1e-9:
            continue
        left, top = np.floor(np.minimum(np.minimum(a, b), c)[:2]).astype(int).clip(0)
        right, bottom = np.ceil(np.maximum(np.maximum(a, b), c)[:2]).astype(int) + 1
        window = depth[top:bottom, left:right]
        if window.min() >= max(a[2], b[2], c[2]):
            continue
        y, x = np.mgrid[top : top + window.shape[0], left : left + window.shape[1]] + 0.5
        v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        u = 1 - v - w
        near = u * a[2] + v * b[2] + w * c[2]
        shown = (u >= 0) & (v >= 0) & (w >= 0) & (near > window)
        if not shown.any():
            continue
        window[shown] = near[shown]
        at = np.stack([u, v, w], axis=-1)[shown] @ spots
        column = (at[:, 0] * columns).astype(int).clip(0, columns - 1)
        row = ((1 - at[:, 1]) * rows).astype(int).clip(0, rows - 1)
        colors = mesh.texture[row, column] * light
        picture[top:bottom, left:right][shown] = np.column_stack(
            [colors, np.full(len(colors), 255)]
        ).astype(np.uint8)
