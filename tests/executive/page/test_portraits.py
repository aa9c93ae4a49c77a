"""The pictures of things are drawn from what they look like."""

import io
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from executive.page.portraits import SIDE, Portraits, portrait
from executive.records import Shape
from executive.types.geometry import Pose
from sim.objects.objects import ObjectModel, load_objects


def drawn(model: ObjectModel) -> np.ndarray:
    picture = Image.open(io.BytesIO(portrait(model)))
    assert picture.size == (SIDE, SIDE)
    return np.asarray(picture.convert("RGBA"))


def color(picture: np.ndarray) -> list[int]:
    """The middle colour of what is not ground."""
    return np.median(picture[picture[..., 3] == 255][:, :3], axis=0).astype(int).tolist()


@pytest.mark.parametrize("name", load_objects())
def test_each_thing_of_the_package_is_drawn_on_a_ground_that_can_be_seen_through(name: str) -> None:
    opaque = drawn(load_objects()[name])[..., 3] > 0
    assert 0.05 < opaque.mean() < 0.9
    assert not opaque[0].any()


def test_the_red_mug_is_red_and_the_banana_is_yellow() -> None:
    red, green, blue = color(drawn(load_objects()["mug"]))
    assert red > 2 * max(green, blue)
    red, green, blue = color(drawn(load_objects()["banana"]))
    assert min(red, green) > 2 * blue


@pytest.mark.parametrize("kind", ["box", "cylinder", "sphere"])
def test_a_thing_without_a_mesh_looks_like_its_form(kind: str) -> None:
    shape = Shape(kind, (0.1, 0.1, 0.1), (0.0, 0.0, 1.0, 1.0), Pose())
    red, green, blue = color(drawn(replace(load_objects()["mug"], look=None, shapes=(shape,))))
    assert blue > 100
    assert red == green == 0


def test_there_is_no_picture_of_what_is_not_known_or_cannot_be_read() -> None:
    lost = Shape("mesh", (1.0, 1.0, 1.0), (1.0, 1.0, 1.0, 1.0), mesh="/nowhere/textured.obj")
    portraits = Portraits({"ghost": replace(load_objects()["mug"], look=lost)})
    assert portraits.png("ghost") is None
    assert portraits.png("unicorn") is None
