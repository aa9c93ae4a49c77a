"""Whether a thing stands where it was put, judged by what the depth camera sees."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from executive.types import Pose
from sim.forms import forms
from sim.objects import load_objects
from sim.placing import stands
from sim.registration import locate_fallen
from sim.solids import Floats, sample_surface

MODELS = load_objects()
EYE = np.array([1.2, 1.0, 1.4])
SPOT = Pose((2.0, 1.0, 0.75), (0.0, 0.0, np.sin(0.4), np.cos(0.4)))


def seen(name: str, fall: int = 0, off: float = 0.0) -> Floats:
    """The upper side of a thing that stands, or lies on another side, at the spot."""
    points, normals = sample_surface(forms(MODELS[name])[fall].shapes)
    turn = Rotation.from_quat(SPOT.orientation)
    return turn.apply(points[normals[:, 2] > 0.5]) + SPOT.position + (off, 0.0, 0.0)


@pytest.mark.parametrize("name", sorted(MODELS))
def test_what_stands_at_its_spot_stands(name: str):
    assert stands(MODELS[name], SPOT, seen(name)) is None


@pytest.mark.parametrize("name", ["sugar_box", "mustard_bottle", "bleach_cleanser"])
def test_what_lies_on_its_side_fell_over(name: str):
    assert stands(MODELS[name], SPOT, seen(name, fall=1)) == "fell over"


def test_what_is_elsewhere_is_missed():
    found = stands(MODELS["sugar_box"], SPOT, seen("sugar_box", off=0.5))
    assert found == "is not where I put it"


def test_what_is_far_above_does_not_count():
    board = seen("sugar_box") + (0.0, 0.0, 0.5)
    points = np.concatenate((seen("hammer"), board))
    assert stands(MODELS["hammer"], SPOT, points) is None


def test_the_board_above_does_not_count():
    board = seen("hammer") + (0.0, 0.0, 0.28)
    points = np.concatenate((seen("hammer"), board))
    assert stands(MODELS["hammer"], SPOT, points, clearance=0.3) is None


@pytest.mark.parametrize("name", ["sugar_box", "mustard_bottle", "tomato_soup_can", "mug"])
@pytest.mark.parametrize("fall", [0, 1])
def test_how_a_thing_lies_is_told_from_its_upper_side(name: str, fall: int):
    form, pose = locate_fallen(MODELS[name], seen(name, fall), EYE, support=SPOT.position[2])
    assert form.size[2] == pytest.approx(forms(MODELS[name])[fall].size[2], abs=2e-3)
    assert pose.position[2] == pytest.approx(SPOT.position[2], abs=4e-3)


@pytest.mark.parametrize("name", sorted(MODELS))
def test_every_form_rests_on_its_own_base(name: str):
    for form in forms(MODELS[name]):
        assert form.lower[2] == pytest.approx(0.0, abs=1e-6)
        assert form.upper[2] > 0.0
        assert sorted(form.size) == pytest.approx(sorted(MODELS[name].size), abs=6e-3)
