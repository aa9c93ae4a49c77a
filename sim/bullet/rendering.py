"""Draws a PyBullet world with its TinyRenderer, which runs on the CPU.

Of this project it imports only the engine, so that the process that only draws starts fast.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.engine import BulletClient
from sim.engine import pybullet as p

NEAR_M = 0.05
"""Distance of the near clipping plane."""
BACKGROUND = -1
"""The body id of pixels that show nothing."""
LARGE = 640
"""Pictures of this width or more are drawn in two parts, which two processes can draw at once."""


@dataclass(frozen=True, slots=True)
class Light:
    """One lamp at infinity, and ambient light.

    Attributes:
        direction: towards the lamp, in `map`.
        color: of the lamp; red, green, blue in [0, 1].
        ambient: coefficient of ambient light.
        diffuse: coefficient of diffuse reflection of the lamp.
        specular: coefficient of specular reflection of the lamp.
    """

    direction: tuple[float, float, float] = (-0.4, -0.3, 1.0)
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    ambient: float = 0.65
    diffuse: float = 0.4
    specular: float = 0.02


DAYLIGHT = Light()


@dataclass(frozen=True, slots=True)
class View:
    """The camera and the light of a picture.

    Attributes:
        width: in pixels.
        height: in pixels.
        matrix: transform from `map` to OpenGL's camera frame, 4 x 4, column-major.
        projection: OpenGL's projection matrix, 4 x 4, column-major.
        far: distance of the far clipping plane (metres).
        light: the light in the scene.
    """

    width: int
    height: int
    matrix: tuple[float, ...]
    projection: tuple[float, ...]
    far: float
    light: Light


@dataclass(frozen=True, slots=True, eq=False)
class Rendering:
    """The renderer's output for one picture.

    Attributes:
        color: (height, width, 3) uint8, RGB.
        depth: (height, width) float32, metres along the optical axis; infinite for background.
        segmentation: (height, width) int32, body ids; BACKGROUND for background.
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
    """Split a large view into its even and its odd columns; return any other view as it is.

    The picture is the same, bit for bit, whether one process draws both parts or two draw one each.
    Each part takes half as long as the whole.
    """
    if view.width < LARGE or view.width % 2:
        return (view,)
    return tuple(_every_second_column(view, first) for first in (0, 1))


def _every_second_column(view: View, first: int) -> View:
    """Every second column from `first`: columns are twice as wide, and shifted to sample there."""
    projection = list(view.projection)
    projection[8] += 2 * first / view.width
    return replace(view, width=view.width // 2, projection=tuple(projection))


def interleaved(parts: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """Pixels (height, width, ...) of the whole view, with columns taken from the parts in turn."""
    height, width, *channels = parts[0].shape
    whole = np.empty((height, width * len(parts), *channels), parts[0].dtype)
    for number, part in enumerate(parts):
        for channel in np.ndindex(*channels):  # five times as fast as all channels at once
            whole[(..., slice(number, None, len(parts)), *channel)] = part[(..., *channel)]
    return whole


def draw_part(client: BulletClient, view: View) -> Rendering:
    """Draw a view in one call of the renderer, without splitting it."""
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
    for channel in range(3):  # five times as fast as all channels at once
        rgb[..., channel] = pixels[..., channel]
    return Rendering(rgb, metres.astype(np.float32), bodies)
