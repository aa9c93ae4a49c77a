"""Meshes of the mug, the pitcher and the wood blocks."""

import numpy as np
from PIL.Image import Image

from sim.modelling.parts import Part, box, cap, lathe, ring, smooth, sweep
from sim.modelling.skins import Label, blend, gradient, noise, plain


def mug() -> list[Part]:
    """Red glaze, empty."""
    red, dark = "#c9302c", "#a82422"
    glaze = Label(251, 82, red).rectangle(0, 0, 251, 2.5, "#d9564f").rectangle(0, 78, 251, 82, dark)
    outside = [(0.037, 0.0), (0.040, 0.004), (0.040, 0.080), (0.0393, 0.082)]
    inside = [(0.0367, 0.082), (0.036, 0.080), (0.036, 0.008), (0.033, 0.005)]
    y, z = np.array(
        [(0.038, 0.066), (0.055, 0.068), (0.071, 0.058), (0.0715, 0.032), (0.058, 0.018)]
    ).T
    spine = smooth(np.column_stack((0 * y, y, z)).tolist() + [(0, 0.038, 0.017)], 12)
    return [
        lathe(outside, glaze.image(), count=24),
        lathe([outside[-1], inside[0]], plain(red), count=24),
        lathe(inside, _shaded(red, "#8c1d1b"), count=24),
        cap(ring(0.066, 0.066, 0.005, count=24), plain("#9a211f")),
        cap(ring(0.074, 0.074, 0.0, count=24), plain("#d8cfc4"), up=False),
        *sweep(spine, (0.009, 0.012), plain(red), 0.8, 8, plain(red)),
    ]


def pitcher_base() -> list[Part]:
    """Blue plastic with a scale and a handle, empty."""
    blue, dark = "#3f7fd0", "#2f62a8"
    side = Label(339, 235, blue).rectangle(0, 0, 339, 8, dark).rectangle(0, 229, 339, 235, dark)
    for turn in (339 * 0.25, 339 * 0.75):
        for step in range(6):
            y = 205 - 30 * step
            side.rectangle(turn - 18, y, turn + 2, y + 2, "#eef4fb")
            side.rectangle(turn - 18, y - 15, turn - 8, y - 13.5, "#eef4fb")
            side.text(turn + 14, y, str(step + 1), 7, "#eef4fb")
    outside = [(0.052, 0.0), (0.054, 0.004), (0.054, 0.233), (0.0535, 0.235)]
    inside = [(0.0505, 0.235), (0.050, 0.233), (0.050, 0.008), (0.046, 0.005)]
    x, z = np.array(
        [(0.052, 0.207), (0.080, 0.207), (0.092, 0.196), (0.092, 0.085), (0.082, 0.070)]
    ).T
    spine = np.column_stack((x, 0 * x, z)).tolist() + [(0.052, 0, 0.070)]
    return [
        lathe(outside, side.image(), count=24),
        lathe([outside[-1], inside[0]], plain(dark), count=24),
        lathe(inside, _shaded(blue, "#234c86"), count=24),
        cap(ring(0.092, 0.092, 0.005, count=24), plain("#28558f")),
        cap(ring(0.104, 0.104, 0.0, count=24), plain(dark), up=False),
        *sweep(spine, (0.019, 0.022), plain(dark), 0.6, 12, plain(dark)),
    ]


def colored_wood_blocks() -> list[Part]:
    """Eight painted cubes: a row of three, a row of three, two on top."""
    edge = 0.026
    red, green, blue, yellow = (
        _painted(*colors)
        for colors in (
            ("#b02a22", "#dd4a3c"),
            ("#236d31", "#3fa04e"),
            ("#214c9e", "#3f72d2"),
            ("#cfa81c", "#f5d544"),
        )
    )
    below = (
        (-1, -1, red),
        (-1, 0, green),
        (-1, 1, blue),
        (1, -1, yellow),
        (1, 0, blue),
        (1, 1, red),
    )
    parts = [
        part
        for x, y, skin in below
        for part in box((edge,) * 3, (x * edge / 2, y * edge, edge / 2), skin)
    ]
    for x, skin in ((-1, yellow), (1, green)):
        parts += box((edge,) * 3, (x * edge / 2, 0, 1.5 * edge), skin)
    return parts


def _painted(dark: str, light: str) -> Image:
    """Painted wood: grain, and worn darker edges."""
    across, up = gradient(26, 26)
    border = np.minimum.reduce((across, 1 - across, up, 1 - up)) < 0.05
    grain = 0.45 + 0.5 * noise(26, 26, (26, 2), 11)
    return blend((dark, light), np.where(border, 0.0, grain))


def _shaded(top: str, bottom: str) -> Image:
    """The inside of a vessel: darker towards its floor. The skin's bottom is the rim."""
    return blend((top, bottom), gradient(8, 80)[1])
