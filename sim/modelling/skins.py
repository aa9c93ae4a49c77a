"""Textures for the surfaces of objects: printed labels, and materials with irregularities.

Lengths are in millimetres on the object's surface; the origin of a picture is its upper left
corner. Everything is drawn by code with fixed seeds, without pictures or brands of others.
"""

from collections.abc import Sequence
from typing import Self

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageColor, ImageDraw, ImageFont

DENSITY = 1.5
"""Pixels per millimetre."""
_FINE = 4
"""Labels are drawn with this many times the resolution, then reduced."""


class Label:
    """A printed surface."""

    def __init__(self, width: float, height: float, paper: str) -> None:
        """Start with a blank sheet of this size and colour."""
        self._scale = DENSITY * _FINE
        size = (round(width * self._scale), round(height * self._scale))
        self._image = Image.new("RGB", size, paper)
        self._draw = ImageDraw.Draw(self._image)

    def rectangle(self, left: float, top: float, right: float, bottom: float, ink: str) -> Self:
        """Fill a rectangle."""
        self._draw.rectangle(self._scaled(left, top, right, bottom), ink)
        return self

    def ellipse(self, x: float, y: float, width: float, height: float, ink: str) -> Self:
        """Fill an ellipse around (x, y)."""
        box = (x - width / 2, y - height / 2, x + width / 2, y + height / 2)
        self._draw.ellipse(self._scaled(*box), ink)
        return self

    def polygon(self, points: Sequence[tuple[float, float]], ink: str) -> Self:
        """Fill a polygon."""
        self._draw.polygon([(x * self._scale, y * self._scale) for x, y in points], ink)
        return self

    def line(self, points: Sequence[tuple[float, float]], width: float, ink: str) -> Self:
        """Draw a line through points."""
        scaled = [(x * self._scale, y * self._scale) for x, y in points]
        self._draw.line(scaled, ink, round(width * self._scale), joint="curve")
        return self

    def text(self, x: float, y: float, words: str, width: float, ink: str) -> Self:
        """Write words of this width around (x, y)."""
        wide = self._draw.textlength(words, ImageFont.load_default(100))
        points = 100 * width * self._scale / wide
        font = ImageFont.load_default(points)
        at = (x * self._scale, y * self._scale)
        self._draw.text(at, words, ink, font, anchor="mm", stroke_width=round(points / 30))
        return self

    def image(self) -> Image.Image:
        """The label in the density of all skins."""
        width, height = (max(1, length // _FINE) for length in self._image.size)
        return self._image.resize((width, height), Image.Resampling.LANCZOS)

    def _scaled(self, *lengths: float) -> tuple[float, ...]:
        return tuple(length * self._scale for length in lengths)


def plain(color: str) -> Image.Image:
    """One colour everywhere."""
    return Image.new("RGB", (8, 8), color)


def blend(colors: Sequence[str], weight: NDArray[np.float64]) -> Image.Image:
    """Interpolate colours by a weight (height, width): 0 gives the first, 1 the last."""
    inks = np.array([ImageColor.getrgb(color)[:3] for color in colors], dtype=np.float64)
    stops = np.linspace(0, 1, len(colors))
    channels = [np.interp(weight, stops, inks[:, channel]) for channel in range(3)]
    return Image.fromarray(np.stack(channels, axis=-1).round().astype(np.uint8))


def noise(
    width: float, height: float, patch: tuple[float, float], seed: int
) -> NDArray[np.float64]:
    """Smooth noise from 0 to 1 with patches of this size; left and right edges match."""
    size = (round(width * DENSITY), round(height * DENSITY))
    coarse = (max(2, round(width / patch[0])), max(2, round(height / patch[1])))
    values = np.random.default_rng(seed).random((coarse[1], coarse[0]))
    wrapped = Image.fromarray(np.concatenate((values,) * 3, axis=1).astype(np.float32))
    wide = np.asarray(wrapped.resize((3 * size[0], size[1]), Image.Resampling.BICUBIC))
    smooth: NDArray[np.float64] = wide[:, size[0] : 2 * size[0]].astype(np.float64)
    return np.clip(smooth, 0.0, 1.0)


def mottled(
    colors: Sequence[str], width: float, height: float, patch: float, seed: int = 0
) -> Image.Image:
    """Spots of colours, large ones with finer ones in them."""
    rough = noise(width, height, (patch, patch), seed)
    fine = noise(width, height, (patch / 4, patch / 4), seed + 1)
    return blend(colors, 0.7 * rough + 0.3 * fine)


def brushed(colors: Sequence[str], width: float, height: float, seed: int = 0) -> Image.Image:
    """Metal or wood: streaks along the picture's height."""
    streaks = noise(width, height, (1.2, height / 2), seed)
    return blend(colors, 0.75 * streaks + 0.25 * noise(width, height, (8, 8), seed + 1))


def gradient(width: float, height: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The position of each pixel from the left and from the bottom (0 to 1)."""
    columns, rows = round(width * DENSITY), round(height * DENSITY)
    across, down = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    return across, 1 - down
