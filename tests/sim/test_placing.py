"""Whether a thing stands where it was put, judged by what the depth camera sees."""

from math import dist

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from executive.geometry import Floats
from executive.types.geometry import Pose
from sim.home.home_file import load_home
from sim.manipulation.placing import RIM_M, TIGHT_M, free_spots, stands
from sim.manipulation.registration import fit_fallen_pose
from sim.objects.objects import load_objects
from sim.objects.resting import lyings
from sim.objects.solids import sample_surface

MODELS = load_objects()
EYE = np.array([1.2, 1.0, 1.4])
SPOT = Pose((2.0, 1.0, 0.75), (0.0, 0.0, np.sin(0.4), np.cos(0.4)))


def seen(name: str, fall: int = 0, off: float = 0.0) -> Floats:
    """The upper side of a thing that stands, or lies on another side, at the spot."""
    points, normals = sample_surface(lyings(MODELS[name])[fall].model.shapes)
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
    form, pose = fit_fallen_pose(MODELS[name], seen(name, fall), EYE, support=SPOT.position[2])
    assert form.size[2] == pytest.approx(lyings(MODELS[name])[fall].model.size[2], abs=2e-3)
    assert pose.position[2] == pytest.approx(SPOT.position[2], abs=4e-3)


@pytest.mark.parametrize("name", sorted(MODELS))
def test_every_form_rests_on_its_own_base(name: str):
    for form in (lying.model for lying in lyings(MODELS[name])):
        assert form.lower[2] == pytest.approx(0.0, abs=1e-6)
        assert form.upper[2] > 0.0
        assert sorted(form.size) == pytest.approx(sorted(MODELS[name].size), abs=6e-3)


TABLE = load_home("four_rooms").delivery
(TOP,) = TABLE.surfaces()


def table_top(*, hidden_beyond: float = 1.0) -> Floats:
    """The empty delivery table as a camera sees it, up to so far behind its front edge (metres)."""
    behind, across = np.mgrid[0.01 : min(hidden_beyond, TOP.length_x) : 0.01, -0.3:0.3:0.01]
    ahead = (TOP.length_x / 2 - behind).ravel()
    return np.array(
        [TABLE.to_map((x, y, TOP.center[2])) for x, y in zip(ahead, across.ravel(), strict=True)]
    )


def standing(name: str, spot: Pose) -> Floats:
    points, _ = sample_surface(MODELS[name].shapes)
    return Rotation.from_quat(spot.orientation).apply(points) + spot.position


def test_a_table_takes_as_many_small_things_as_fit():
    seen, names = table_top(), ["apple", "orange", "mug", "tomato_soup_can", "banana", "peach"]
    for name in names:
        spot = next(free_spots(TABLE, TOP, MODELS[name], seen), None)
        assert spot, f"no room for the {name}"
        seen = np.concatenate((seen, standing(name, spot)))


def test_what_is_not_seen_behind_other_things_is_not_taken_for_free():
    seen = table_top(hidden_beyond=0.2)
    depths = [behind_front(spot) for spot in free_spots(TABLE, TOP, MODELS["apple"], seen)]
    assert max(depths) == pytest.approx(RIM_M, abs=0.01)
    assert max(map(behind_front, free_spots(TABLE, TOP, MODELS["apple"], table_top()))) > 0.3


def behind_front(spot: Pose) -> float:
    x, y, yaw = TABLE.pose
    out = np.array([np.cos(yaw), np.sin(yaw)])
    return float(TABLE.size[0] / 2 - (np.array(spot.position[:2]) - (x, y)) @ out)


def test_a_thing_is_put_down_beside_another_with_room_for_fingers():
    first = next(free_spots(TABLE, TOP, MODELS["apple"], table_top()))
    seen = np.concatenate((table_top(), standing("apple", first)))
    spots = list(free_spots(TABLE, TOP, MODELS["apple"], seen))
    apart = [dist(spot.position, first.position) for spot in spots]
    assert min(apart) > MODELS["apple"].size[0] + TIGHT_M - 0.01
