"""From pixels and depth to points in the map."""

import math

import numpy as np
import pytest

from executive.geometry import back_project, transform
from executive.perception.pipeline import locate
from executive.types.geometry import Pose
from executive.types.perception import Box, Detection, Frame, Intrinsics

INTRINSICS = Intrinsics(width=64, height=48, fx=60.0, fy=60.0, cx=31.5, cy=23.5)
LOOKING_DOWN = Pose((1.0, 2.0, 1.5), (1.0, 0.0, 0.0, 0.0))


def frame_with(depth: float) -> Frame:
    return Frame(
        0,
        np.zeros((48, 64, 3), np.uint8),
        np.full((48, 64), depth, np.float32),
        INTRINSICS,
        LOOKING_DOWN,
    )


def test_the_middle_of_a_picture_taken_from_above_is_right_below() -> None:
    rows, columns = np.array([23, 24]), np.array([31, 32])
    points = back_project(frame_with(0.7), rows, columns)
    assert points.mean(axis=0) == pytest.approx([1.0, 2.0, 0.8], abs=1e-6)


def test_pixels_without_depth_are_left_out() -> None:
    points = back_project(frame_with(math.inf), np.array([3]), np.array([4]))
    assert points.shape == (0, 3)


def test_a_detection_is_located_by_its_mask() -> None:
    seen = Detection("mug", 0.9, Box(20, 10, 12, 12), np.ones((12, 12), np.bool_))
    located = locate(seen, frame_with(0.7))
    assert seen.position is None
    assert located.position == pytest.approx(
        (1.0 - 6 / 60 * 0.7, 2.0 + 8 / 60 * 0.7, 0.8), abs=0.01
    )
    assert len(located.points) == 100, "one pixel of the rim is left out"


def test_a_quarter_turn_about_z_turns_x_into_y() -> None:
    turn = Pose((0.0, 0.0, 1.0), (0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4)))
    assert transform(turn, np.array([[1.0, 0.0, 0.0]])) == pytest.approx(np.array([[0, 1, 1]]))


@pytest.mark.parametrize(("left", "top"), [(0, 10), (20, 1), (52, 10), (20, 36)])
def test_what_reaches_the_edge_of_the_picture_is_cut_off(left: int, top: int) -> None:
    seen = Detection("mug", 0.9, Box(left, top, 12, 12), np.ones((12, 12), np.bool_))
    assert locate(seen, frame_with(0.7)).cut_off


def test_what_is_wholly_in_the_picture_is_not_cut_off() -> None:
    seen = Detection("mug", 0.9, Box(20, 10, 12, 12), np.ones((12, 12), np.bool_))
    assert not locate(seen, frame_with(0.7)).cut_off
