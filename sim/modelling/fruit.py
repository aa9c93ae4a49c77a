"""Meshes of fruit, and of the tennis ball, which looks similar: round objects without print.

Apple, peach and orange have similar shapes and sizes, as real ones do.
"""

import numpy as np
from PIL.Image import Image

from executive.geometry import Floats
from sim.modelling.parts import Part, cap, lathe, loft, ring, sphere, sweep
from sim.modelling.skins import Label, blend, gradient, mottled, noise, plain


def apple() -> list[Part]:
    """Red with a paler cheek, yellow-green around the stem."""
    d = 0.075
    profile = np.array(
        [(0, 0.06), (0.10, 0.02), (0.20, 0), (0.31, 0.08), (0.43, 0.27), (0.5, 0.53)]
        + [(0.46, 0.76), (0.36, 0.92), (0.24, 0.98), (0.11, 0.95), (0, 0.86)]
    )
    across, up = gradient(236, 118)
    streaks = noise(236, 118, (5, 60), 1)
    cheek = 0.5 + 0.5 * np.cos(2 * np.pi * (across - 0.7))
    ripe = 1.15 - 0.35 * cheek * (1 - np.abs(2 * up - 1)) - 0.35 * streaks
    ripe -= 0.9 * np.clip((up - 0.86) / 0.14, 0, 1) + 0.5 * np.clip((0.1 - up) / 0.1, 0, 1)
    skin = blend(("#b9b04a", "#cf6a35", "#b3202a", "#8c1420"), np.clip(ripe, 0, 1))
    return [lathe(profile * d, skin, steps=14), _stem(0.062, 0.075, 0.003)]


def orange() -> list[Part]:
    """Pores, and a small green calyx."""
    across, up = gradient(230, 115)
    pores = noise(230, 115, (2.2, 2.2), 3)
    hue = 0.5 + 0.35 * (pores - 0.5) + 0.2 * (noise(230, 115, (40, 40), 4) - 0.5)
    skin = blend(("#d96a0c", "#f28a1c", "#f7a540"), hue)
    d = 0.073
    calyx = cap(ring(0.009, 0.009, d, 0.6, 10), plain("#6d7a2c"))
    return [sphere(d, skin), calyx]


def peach() -> list[Part]:
    """Yellow with a red cheek, and a groove from pole to pole."""
    d = 0.059
    across, up = gradient(186, 93)
    cheek = 0.5 + 0.5 * np.cos(2 * np.pi * (across - 0.35))
    fuzz = noise(186, 93, (14, 14), 5)
    skin = blend(
        ("#f3c06a", "#f0a264", "#e57a52", "#c8443f"),
        np.clip(0.75 * cheek + 0.6 * (fuzz - 0.5) + 0.25 * (up - 0.5), 0, 1),
    )
    ball = sphere(d, skin)
    angle = np.arctan2(ball.points[:, 1], ball.points[:, 0])
    groove = 1 - 0.05 * np.exp(-((angle / 0.25) ** 2))
    ball.points[:, :2] *= groove[:, None]
    return [ball, _stem(d - 0.002, d, 0.006)]


def pear() -> list[Part]:
    """Yellow-green with brown freckles."""
    profile = [(0, 0.002), (0.012, 0), (0.026, 0.010), (0.033, 0.033), (0.0285, 0.052)]
    profile += [(0.0235, 0.068), (0.0205, 0.082), (0.013, 0.093), (0, 0.0945)]
    across, up = gradient(207, 120)
    cheek = 0.5 + 0.5 * np.cos(2 * np.pi * (across - 0.6))
    hue = 0.2 + 0.45 * cheek * (1 - up) + 0.35 * noise(207, 120, (16, 16), 6)
    freckles = noise(207, 120, (2.5, 2.5), 7) > 0.9
    skin = blend(("#a9b83a", "#c3c646", "#d4bd4c", "#a9823a"), np.where(freckles, 0.9, hue))
    return [lathe(profile, skin, steps=14), _stem(0.092, 0.100, 0.005)]


def banana() -> list[Part]:
    """Bent, five-sided, with brown ends."""
    y = np.array([-0.094, -0.088, -0.078, -0.058, -0.03, 0, 0.03, 0.058, 0.074, 0.084, 0.094])
    width = np.array([9, 14, 24, 30, 35, 36, 35, 31, 25, 14, 11]) / 1000
    spine = np.column_stack((3.4 * y**2, y, width / 2 * 0.6 + 0.0072))
    across, along = gradient(100, 200)
    ripe = 0.5 + 0.3 * (noise(100, 200, (12, 40), 8) - 0.5)
    ripe += 0.35 * np.clip((along - 0.86) / 0.05, 0, 1) * (along < 0.93)
    ripe -= 0.45 * np.clip((0.06 - along) / 0.04, 0, 1)
    dark = (noise(100, 200, (6, 10), 9) > 0.93) | (along < 0.02) | (along > 0.975)
    skin = blend(
        ("#b5a22e", "#ecca35", "#f3d84e", "#c8c04a", "#4a3418"), np.where(dark, 0.95, ripe * 0.9)
    )
    widths = np.column_stack((width, width))
    return sweep(spine, widths, skin, roundness=0.85, count=10, ends=plain("#3b2a14"))


def strawberry() -> list[Part]:
    """Stands on its leaves, the tip up."""
    profile = [(0.008, 0.004), (0.018, 0.008), (0.022, 0.020), (0.0205, 0.030), (0.015, 0.043)]
    profile += [(0.008, 0.052), (0, 0.055)]
    skin = Label(138, 70, "#c81f33")
    for row in range(9):
        for column in range(14):
            x, y = (column + row % 2 / 2) * 138 / 14, 5 + row * 7.5
            skin.ellipse(x, y, 2.6, 3.6, "#8e1020").ellipse(x, y - 0.3, 1.5, 2.3, "#f0cf72")
    flat = ring(0.030, 0.030, 0, count=20)
    flat[::2, :2] *= 0.55
    leaf = mottled(("#2f7a2b", "#4f9c3c"), 30, 30, 8)
    return [
        lathe(profile, skin.image(), steps=12, count=18),
        cap(flat, leaf, up=False),
        cap(flat + (0, 0, 0.003), leaf),
        lathe([(0.013, 0.002), (0.010, 0.0055)], leaf, count=10),
    ]


def tennis_ball() -> list[Part]:
    """Yellow-green felt with the white seam."""
    d, width, height = 0.065, 204, 102
    t = np.linspace(0, 2 * np.pi, 400)
    a, b = 0.72, 0.28
    seam = np.column_stack(
        (a * np.cos(t) + b * np.cos(3 * t), a * np.sin(t) - b * np.sin(3 * t))
        + (2 * (a * b) ** 0.5 * np.sin(2 * t),)
    )
    felt = noise(width, height, (3, 3), 10)
    skin = blend(("#b4cc28", "#cbe03a", "#d9ea5e"), 0.6 * felt + 0.2)
    across, up = gradient(width, height)
    lon, lat = 2 * np.pi * (across - 0.5), np.pi * (up - 0.5)
    sight = np.stack((np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)), axis=-1)
    near = (sight @ seam.T).max(axis=-1) > np.cos(0.075)
    skin.paste("#f4f4ec", mask=_mask(near))
    return [sphere(d, skin)]


def _stem(low: float, high: float, width: float) -> Part:
    rings = [ring(width * f, width * f, z, count=6) for f, z in ((1, low), (0.8, high), (0, high))]
    return loft(rings, plain("#5a3d1e"))


def _mask(where: Floats) -> Image:
    return blend(("#000000", "#ffffff"), where.astype(np.float64)).convert("L")
