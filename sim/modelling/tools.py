"""Meshes of tools, lying; the drill stands on its battery."""

import numpy as np
from numpy.typing import ArrayLike

from executive.geometry import Floats
from sim.modelling.parts import Part, box, cap, lathe, loft, prism, ring, solid, sweep
from sim.modelling.skins import Label, brushed, mottled, plain

_STEEL = ("#6c7379", "#a2a9af", "#868e95")
_CHROME = ("#7d858c", "#c5cbd0", "#99a1a8")
_RUBBER = ("#1b1b1d", "#2d2d30")


def adjustable_wrench() -> list[Part]:
    """A flat handle with a hole, a head with a fixed and a sliding jaw, a knurled screw."""
    steel = brushed(_CHROME, 24, 150)
    face = Label(150, 24, "#99a1a8").rectangle(32, 5, 128, 19, "#7b838a")
    face.text(80, 12, "10 IN", 34, "#c9ced3").ellipse(12, 12, 12, 12, "#202326")
    end = [(0.012 * np.cos(a), -0.0905 - 0.012 * np.sin(a)) for a in np.linspace(0, np.pi, 7)]
    handle = [*reversed(end), (0.008, -0.06), (0.009, 0.02), (0.012, 0.0475)]
    handle += [(-0.012, 0.0475), (-0.009, 0.02), (-0.008, -0.06)]
    head = [(-0.0275, 0.060), (-0.012, 0.0475), (0.012, 0.0475), (0.0275, 0.066)]
    head += [(0.0275, 0.0875), (-0.0275, 0.0875)]
    fixed = [(-0.0275, 0.0875), (-0.0095, 0.0875), (-0.0095, 0.1025), (-0.022, 0.1025)]
    sliding = [(0.0135, 0.0875), (0.0275, 0.0875), (0.024, 0.1025), (0.0135, 0.1025)]
    knurls = Label(40, 14, "#6c7379")
    for x in range(0, 40, 4):
        knurls.rectangle(x, 0, x + 1.5, 14, "#3c4146")
    screw = lathe([(0.006, -0.007), (0.006, 0.007)], knurls.image(), count=10)
    shiny = mottled(_CHROME, 30, 30, 10)
    return [
        *prism(handle, 0.0, 0.012, steel, face.image()),
        *prism(head, 0.0, 0.0135, steel, shiny),
        *prism(fixed, 0.0, 0.014, steel, shiny),
        *prism(sliding, 0.0, 0.014, steel, shiny),
        screw.moved((0.012, 0.070, 0.0078), (0, 90, 0)),
    ]


def hammer() -> list[Part]:
    """A steel head with a face and a claw, on a shaft with a blue grip."""
    grip = Label(96, 130, "#1f3f8f")
    for y in range(8, 130, 9):
        grip.rectangle(0, y, 96, y + 3, "#14296a")
    grip.rectangle(0, 0, 96, 4, "#e0b020")
    ys = np.array([-0.165, -0.160, -0.10, -0.045, -0.035])
    widths = np.array([(24, 22), (30, 28), (27, 26), (30, 28), (26, 22)]) / 1000
    handle = sweep(_along_y(ys, [0.014] * 5), widths, grip.image(), ends=plain("#14296a"))
    steel = brushed(_STEEL, 80, 150)
    shaft = sweep(
        _along_y([-0.035, 0.12], [0.016] * 2), (0.024, 0.020), steel, 0.5, 16, plain(_STEEL[1])
    )
    dark = mottled(("#3b4046", "#5b6269", "#474d53"), 100, 135, 12)
    flat = [(0.027, 0.0), (0.032, 0.003), (0.032, 0.022), (0.026, 0.030), (0.030, 0.042)]
    flat += [(0.032, 0.055), (0.032, 0.080)]
    rings = [ring(d, d, z) for d, z in flat]
    rings += [ring(0.026, 0.032, 0.105), ring(0.018, 0.032, 0.125), ring(0.014, 0.031, 0.135)]
    head = [loft(rings, dark), cap(rings[0], plain("#8d949a"), up=False), cap(rings[-1], dark)]
    return [
        *handle,
        *shaft,
        *(part.moved((-0.0675, 0.131, 0.016), (0, 90, 0)) for part in head),
    ]


def power_drill() -> list[Part]:
    """Orange motor, black grip and battery, a tapering chuck."""
    orange, black = "#e06a1a", "#232325"
    housing = Label(157, 130, orange).rectangle(0, 92, 157, 130, "#c4560f")
    for middle in (39.0, 118.0):
        housing.rectangle(middle - 18, 40, middle + 18, 84, black)
        for y in (98, 105, 112, 119):
            housing.rectangle(middle - 14, y, middle + 14, y + 3, black)
    profile = ((0.034, -0.065), (0.047, -0.055), (0.050, -0.03), (0.050, 0.04), (0.040, 0.065))
    motor = solid([ring(d, d, z) for d, z in profile], housing.image(), plain(black))
    chuck_profile = ((0.030, 0.0), (0.030, 0.030), (0.022, 0.047), (0.010, 0.0575))
    metal = brushed(("#2a2a2c", "#5a5d60"), 94, 57)
    chuck = solid([ring(d, d, z, count=14) for d, z in chuck_profile], metal, plain("#9aa0a6"))
    rubber = mottled(_RUBBER, 80, 90, 6)
    grips = (
        (0.035, 0.046, 0.044),
        (0.032, 0.040, 0.07),
        (0.033, 0.042, 0.10),
        (0.035, 0.046, 0.145),
    )
    grip = loft([ring(x, y, z, 0.7) for x, y, z in grips], rubber).moved((0, -0.020, 0))
    pack = Label(300, 45, black).rectangle(0, 8, 300, 14, orange)
    for middle in (0, 150, 300):
        pack.text(middle, 29, "18V", 34, "#f4f4f4")
    sizes = (
        (0.053, 0.106, 0.0),
        (0.057, 0.110, 0.004),
        (0.057, 0.110, 0.040),
        (0.050, 0.100, 0.045),
    )
    battery = solid([ring(x, y, z, 0.3, 28) for x, y, z in sizes], pack.image(), plain(black))
    trigger = box((0.014, 0.012, 0.026), (0, 0.003, 0.118), plain("#b8321e"))
    # Both lie along y: the housing's seam is below, its badge at either side.
    return [
        *battery,
        grip,
        *trigger,
        *(part.moved((0, -0.020, 0.159), (-90, 0, 0)) for part in motor),
        *(part.moved((0, 0.0445, 0.159), (-90, 0, 0)) for part in chuck),
    ]


def scissors() -> list[Part]:
    """Steel blades, a little open, and orange loops."""
    steel = brushed(_CHROME, 12, 110)
    blade = [(-0.006, -0.008), (0.006, -0.008), (0.006, 0.075), (0.0005, 0.1), (-0.006, 0.06)]
    mirrored = [(-x, y) for x, y in reversed(blade)]
    orange = mottled(("#c94c16", "#e0561f", "#ea6a30"), 44, 180, 12)
    angles = np.linspace(0, 2 * np.pi, 18, endpoint=False)
    width = 0.0145 * np.sin(angles) * (0.7 - 0.3 * np.cos(angles))
    loop = np.column_stack((width, 0.033 * np.cos(angles), 0 * angles))
    tube = sweep(loop, (0.011, 0.014), orange, count=8)
    arm = sweep([(0, -0.02, 0), (0, 0.02, 0)], (0.014, 0.013), orange, 1.0, 8, orange)
    screw = lathe([(0.005, 0.0), (0.005, 0.0135), (0, 0.0135)], plain("#5f666c"), count=10)
    parts = [screw]
    for side, outline, low in ((-1, blade, 0.0), (1, mirrored, 0.006)):
        turn = (0, 0, -side * 4.0)
        parts += [
            p.moved((side * 0.003, 0, 0), turn)
            for p in prism(outline, low, low + 0.006, *[steel] * 2)
        ]
        parts += [p.moved((side * 0.0225, -0.0625, 0.007), (0, 0, side * 17.0)) for p in tube]
        parts += [p.moved((side * 0.0085, -0.020, 0.007), (0, 0, side * 17.0)) for p in arm]
    return parts


def spatula() -> list[Part]:
    """Black, with a steel shaft and a slotted blade."""
    black = mottled(_RUBBER, 24, 140, 10)
    ys = np.array([-0.175, -0.170, -0.11, -0.045, -0.035])
    widths = np.array([(18, 18), (24, 24), (20, 21), (24, 24), (18, 18)]) / 1000
    handle = sweep(_along_y(ys, [0.012] * 5), widths, black, 0.8, 12, black)
    shaft = sweep(
        _along_y([-0.035, 0.06, 0.08], [0.012, 0.012, 0.007]),
        [(0.014, 0.014), (0.014, 0.014), (0.014, 0.008)],
        brushed(_CHROME, 44, 110),
        count=10,
        ends=plain(_CHROME[0]),
    )
    face = Label(100, 83, "#26262a")
    for y in (21, 34.5, 48, 61.5):
        face.rectangle(22, y - 3.5, 78, y + 3.5, "#8a8478")
    corner = 0.012
    outline: list[tuple[float, float]] = []
    for x, y, start in ((1, -1, -90), (1, 1, 0), (-1, 1, 90), (-1, -1, 180)):
        for angle in np.radians([start, start + 45, start + 90]):
            middle = (x * (0.0415 - corner), 0.125 + y * (0.05 - corner))
            outline.append((middle[0] + corner * np.cos(angle), middle[1] + corner * np.sin(angle)))
    blade = prism(outline, 0.0, 0.008, plain("#1d1d1f"), face.image())
    return [*handle, *shaft, *blade]


def _along_y(ys: ArrayLike, heights: ArrayLike) -> Floats:
    y, z = np.asarray(ys, dtype=np.float64), np.asarray(heights, dtype=np.float64)
    return np.column_stack((np.zeros(len(y)), y, z))
