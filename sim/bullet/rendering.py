"""Draws a PyBullet world with its TinyRenderer, which computes on the CPU.

Of ours it imports the engine alone, for it is also used by a process that does nothing else.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.engine import BulletClient
from sim.engine import pybullet as p

NEAR_M = 0.05
BACKGROUND = -1
LARGE = 640
"""Pictures with so many columns are drawn in two parts, which two processes can do at once."""


@dataclass(frozen=True, slots=True)
class Light:
    """One lamp at infinity, and what comes from everywhere.

    Attributes:
        direction: towards the lamp, in `map`.
        color: of the lamp; red, green, blue in [0, 1].
        ambient: share of a surface's colour that it shows without the lamp.
        diffuse: share that the lamp adds where it shines straight on it.
        specular: strength of reflections.
    """

    direction: tuple[float, float, float] = (-0.4, -0.3, 1.0)
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    ambient: float = 0.65
    diffuse: float = 0.4
    specular: float = 0.02


DAYLIGHT = Light()


@dataclass(frozen=True, slots=True)
class View:
    """From where and how a picture is drawn.

    Attributes:
        width: pixels in a row.
        height: rows.
        matrix: `map` in OpenGL's camera frame, column by column.
        projection: OpenGL's, column by column.
        far: how far one sees (metres).
        light: what it is lit by.
    """

    width: int
    height: int
    matrix: tuple[float, ...]
    projection: tuple[float, ...]
    far: float
    light: Light


@dataclass(frozen=True, slots=True, eq=False)
class Rendering:
    """What the renderer says of one picture.

    Attributes:
        color: (height, width, 3) uint8, RGB.
        depth: (height, width) float32, metres along the optical axis, infinite where nothing is.
        segmentation: (height, width) int32, body ids; BACKGROUND where nothing is.
    """

    color: NDArray[np.uint8]
    depth: NDArray[np.float32]
    segmentation: NDArray[np.int32]


def draw(client: BulletClient, view: View) -> Rendering:
    """Draw the world as it is now."""
    drawn = [draw_part(client, part) for part in parts(view)]
    if len(drawn) == 1:
        return drawn[0]
    return Rendering(
        interleaved([part.color for part in drawn]),
        interleaved([part.depth for part in drawn]),
        interleaved([part.segmentation for part in drawn]),
    )


def parts(view: View) -> tuple[View, ...]:
    """What a view is drawn by: itself, or, of a large one, the even and the odd columns.

    Whether one process draws both or each has its own, the picture is the same to the bit. Of such
    parts each takes half as long as the whole.
    """
    if view.width < LARGE or view.width % 2:
        return (view,)
    return tuple(_every_second_column(view, first) for first in (0, 1))


def _every_second_column(view: View, first: int) -> View:
    """The columns from `first` on: columns twice as wide, moved so that they are sampled there."""
    projection = list(view.projection)
    projection[8] += 2 * first / view.width
    return replace(view, width=view.width // 2, projection=tuple(projection))


def interleaved(parts: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """Pixels of the whole (height, width, ...), whose columns are in turn those of the parts."""
    height, width, *channels = parts[0].shape
    whole = np.empty((height, width * len(parts), *channels), parts[0].dtype)
    for number, part in enumerate(parts):
        for channel in np.ndindex(*channels):  # five times as fast as all at once
            whole[(..., slice(number, None, len(parts)), *channel)] = part[(..., *channel)]
    return whole


def draw_part(client: BulletClient, view: View) -> Rendering:
    """Draw all columns of a view in one go."""
    light = view.light
    _, _, color, depth, segmentation = client.getCameraImage(
        view.width,
        view.height,
        view.matrix,
        view.projection,
        lightDirection=light.direction,
        lightColor=light.color,
        lightAmbientCoeff=light.ambient,
        lightDiffuseCoeff=light.diffuse,
        lightSpecularCoeff=light.specular,
        shadow=0,
        renderer=p.ER_TINY_RENDERER,
    )
    shape = view.height, view.width
    bodies = np.asarray(segmentation, np.int32).reshape(shape)
    metres = np.asarray(depth).reshape(shape).astype(np.float64)
    metres *= NEAR_M - view.far  # in place: far * near / (far - (far - near) * depth)
    metres += view.far
    np.divide(view.far * NEAR_M, metres, out=metres)
    metres[bodies == BACKGROUND] = np.inf
    pixels = np.asarray(color, np.uint8).reshape(*shape, 4)
    rgb = np.empty((*shape, 3), np.uint8)
    for channel in range(3):  # five times as fast as all at once
        rgb[..., channel] = pixels[..., channel]
    return Rendering(rgb, metres.astype(np.float32), bodies)
