"""A contact sheet of the objects, each as the simulator's camera sees it."""

from collections.abc import Iterable

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.spatial.transform import Rotation

from executive.types.geometry import Pose
from sim.bullet.bodies import create_body
from sim.bullet.camera import pinhole, render
from sim.bullet.client import connect
from sim.bullet.rendering import BACKGROUND
from sim.objects.objects import ObjectModel

COLUMNS = 6
CELL = 240
"""Side of a picture (pixels)."""
CAPTION = 44
_FINER = 3
"""Pictures are rendered with this many times the resolution, then reduced."""
_PAPER = (250, 250, 248)
_INK, _FAINT = (30, 30, 30), (110, 110, 110)
_HFOV = np.radians(30.0)
_AZIMUTH, _ELEVATION, _STEEP = np.radians((32.0, 28.0, 52.0))
_FLAT = 0.35
"""Objects with a smaller ratio of height to width are shown from a steeper angle."""


def contact_sheet(models: Iterable[ObjectModel]) -> Image.Image:
    """All objects with name, size (cm) and mass; each fills its cell."""
    models = list(models)
    rows = -(-len(models) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * CELL, rows * (CELL + CAPTION)), _PAPER)
    draw = ImageDraw.Draw(sheet)
    for index, model in enumerate(models):
        left, top = index % COLUMNS * CELL, index // COLUMNS * (CELL + CAPTION)
        sheet.paste(portrait(model), (left, top))
        size = " x ".join(f"{100 * length:.1f}" for length in model.size)
        about = f"{size} cm, {1000 * model.mass_kg:.0f} g"
        for y, text, ink, points in ((4, model.name, _INK, 17), (24, about, _FAINT, 13)):
            at = (left + CELL // 2, top + CELL + y)
            draw.text(at, text, ink, ImageFont.load_default(points), anchor="ma")
    return sheet


def portrait(model: ObjectModel) -> Image.Image:
    """One object from its front, a little from the side and above."""
    size = np.array(model.size)
    flat = size[2] < _FLAT * size[:2].max()
    elevation = _STEEP if flat else _ELEVATION
    sight = Rotation.from_euler("ZY", (_AZIMUTH, -elevation))
    distance = 0.55 * float(np.linalg.norm(size)) / np.tan(_HFOV / 2)
    middle = (np.array(model.lower) + model.upper) / 2
    eye = middle + sight.apply((distance, 0.0, 0.0))
    # An optical frame looks along z with y down; the eye looks along -x of its line of sight.
    optical = sight * Rotation.from_matrix(np.array([[0, 0, -1], [1, 0, 0], [0, -1, 0]]))
    client = connect()
    create_body(client, model.shapes, Pose(), look=model.look)
    lens = pinhole(CELL * _FINER, CELL * _FINER, _HFOV)
    seen = render(client, Pose(tuple(eye.tolist()), tuple(optical.as_quat().tolist())), lens)
    client.disconnect()
    color = np.where((seen.segmentation == BACKGROUND)[..., None], _PAPER, seen.color)
    picture = Image.fromarray(color.astype(np.uint8))
    return picture.resize((CELL, CELL), Image.Resampling.LANCZOS)
