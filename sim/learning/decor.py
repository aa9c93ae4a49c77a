"""Domain randomisation: random colours, patterns, light, exposure and noise.

The training pictures of a detector must vary in everything that does not identify an object.
"""

from pathlib import Path

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from PIL import Image

from executive.colors import Color
from sim.bullet.rendering import Light
from sim.engine import BulletClient

PATTERN = 64
"""Side of a pattern (pixels); the renderer stretches it over each face."""
PATTERNS = 48
"""Number of patterns."""


def write_patterns(folder: Path) -> tuple[Path, ...]:
    """Write the patterns (always the same) as PNG files for the simulator."""
    chance = np.random.default_rng(0)
    files = tuple(folder / f"{number}.png" for number in range(PATTERNS))
    for file in files:
        Image.fromarray(_pattern(chance)).save(file)
    return files


def _pattern(chance: Generator) -> NDArray[np.uint8]:
    """Grain, tiles, stripes or patches; bright, because the shape's colour is multiplied by it."""
    row, column = np.mgrid[:PATTERN, :PATTERN]
    match chance.integers(4):
        case 0:
            waves = np.sin(column * chance.uniform(0.3, 1.2) + 2 * np.sin(row * 0.1))
        case 1:
            side = chance.integers(6, 24)
            waves = np.where((row // side + column // side) % 2, 1.0, -1.0)
        case 2:
            side = chance.integers(3, 16)
            waves = np.where((row if chance.random() < 0.5 else column) // side % 2, 1.0, -1.0)
        case _:
            waves = np.kron(chance.uniform(-1, 1, (8, 8)), np.ones((PATTERN // 8,) * 2))
    contrast = chance.uniform(0.03, 0.35)
    noise = chance.normal(0.0, chance.uniform(0.0, 0.06), (PATTERN, PATTERN))
    shade = 1.0 - contrast * (1 - waves) / 2 + noise
    tint = 1.0 - chance.uniform(0.0, 0.2, 3) * (waves[..., None] < 0)
    return np.asarray(255 * np.clip(shade[..., None] * tint, 0, 1), np.uint8)


def draw_color(chance: Generator) -> Color:
    """A random colour; muted ones, as in homes, are more frequent."""
    value = 1.0 - 0.85 * chance.uniform(0.0, 1.0) ** 2
    vivid = chance.uniform(0.0, 1.0) ** 2 * chance.uniform(0.3, 1.0)
    hue = chance.uniform(0.0, 1.0, 3)
    red, green, blue = value * (1 - vivid * (1 - hue / hue.max()))
    return float(red), float(green), float(blue), 1.0


def dress(
    client: BulletClient,
    body: int,
    shapes: int,
    patterns: tuple[Path, ...],
    chance: Generator,
) -> None:
    """Give a body with `shapes` shapes a random colour in several shades, and perhaps a pattern."""
    base = np.array(draw_color(chance)[:3])
    look = {}
    if chance.random() < 0.5:
        look["textureUniqueId"] = client.loadTexture(str(chance.choice(np.array(patterns))))
    for index in range(shapes):
        shade = np.clip(base * chance.uniform(0.7, 1.1), 0, 1)
        client.changeVisualShape(body, -1, shapeIndex=index, rgbaColor=[*shade, 1.0], **look)


def draw_light(chance: Generator) -> Light:
    """A whitish lamp of random direction, from above, and random strength."""
    azimuth, height = chance.uniform(0, 2 * np.pi), chance.uniform(0.3, np.pi / 2)
    red, green, blue = chance.uniform(0.8, 1.0, 3)
    return Light(
        direction=(
            float(np.cos(azimuth) * np.cos(height)),
            float(np.sin(azimuth) * np.cos(height)),
            float(np.sin(height)),
        ),
        color=(float(red), float(green), float(blue)),
        ambient=float(chance.uniform(0.4, 0.75)),
        diffuse=float(chance.uniform(0.2, 0.6)),
        specular=float(chance.uniform(0.0, 0.1)),
    )


def through_the_lens(color: NDArray[np.uint8], chance: Generator) -> NDArray[np.uint8]:
    """The picture (height, width, 3) with another exposure and white balance, and with noise."""
    gain = chance.uniform(0.75, 1.2) * chance.uniform(0.94, 1.06, 3)
    noise = chance.normal(0.0, chance.uniform(0.0, 6.0), color.shape)
    return np.clip(color * gain + noise, 0, 255).astype(np.uint8)
