"""The pixels of a thing are found in the depth of its box."""

import tempfile
from pathlib import Path

import numpy as np
import pytest

from executive.perception.pipeline import locate
from executive.perception.segmentation import segment
from executive.types.geometry import Pose
from executive.types.perception import Box, Detection, Frame, Intrinsics

LENS = Intrinsics(width=160, height=120, fx=150.0, fy=150.0, cx=79.5, cy=59.5)
FROM_ABOVE = Pose((0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 0.0))
BOX = Box(60, 40, 30, 30)


def frame(*blocks: tuple[slice, slice, float]) -> Frame:
    """A floor 1 m below the camera, with blocks: rows, columns and the depth of their tops."""
    depth = np.full((LENS.height, LENS.width), 1.0, np.float32)
    for rows, columns, top in blocks:
        depth[rows, columns] = top
    return Frame(0, np.zeros((*depth.shape, 3), np.uint8), depth, LENS, FROM_ABOVE)


THING = (slice(42, 68), slice(62, 88), 0.93)


def test_what_a_thing_stands_on_is_left_out() -> None:
    mask = segment(frame(THING), BOX)
    expected = np.zeros((30, 30), np.bool_)
    expected[2:28, 2:28] = True
    assert (mask == expected).all()


def test_a_flat_thing_is_told_from_what_it_lies_on() -> None:
    mask = segment(frame((*THING[:2], 0.988)), BOX)
    assert mask.sum() == 26 * 26


def test_a_neighbour_whose_corner_is_in_the_box_is_left_out() -> None:
    thing = (slice(42, 68), slice(62, 80), 0.93)
    neighbour = (slice(50, 110), slice(82, 140), 0.85)
    mask = segment(frame(thing, neighbour), BOX)
    assert not mask[:, 22:].any()
    assert mask[2:28, 2:20].all()


def test_what_is_behind_is_left_out() -> None:
    low_floor = (slice(0, 40), slice(0, 160), 1.6)
    mask = segment(frame(THING, low_floor), BOX)
    assert mask.sum() == 26 * 26


def test_the_bottom_of_a_hollow_thing_belongs_to_it() -> None:
    bottom = (slice(48, 62), slice(68, 82), 0.985)
    mask = segment(frame((*THING[:2], 0.9), bottom), BOX)
    assert mask.sum() == 26 * 26


def test_a_higher_handle_and_a_flat_blade_are_one_thing() -> None:
    handle = (slice(42, 68), slice(62, 72), 0.962)
    blade = (slice(48, 62), slice(72, 88), 0.99)
    mask = segment(frame(handle, blade), BOX)
    assert mask.sum() == 26 * 10 + 14 * 16


def test_the_top_of_a_neighbour_is_not_what_a_thing_stands_on() -> None:
    thing = [(slice(42 + row, 43 + row), slice(62, 88), 0.9 + 0.003 * row) for row in range(30)]
    box = Box(60, 40, 30, 34)
    neighbour = (slice(60, 76), slice(30, 62), 0.94)
    mask = segment(frame(*thing, neighbour), box)
    assert mask[26, 10]


def test_without_depth_all_of_the_box_is_the_thing() -> None:
    nothing = frame((slice(0, 120), slice(0, 160), np.inf))
    assert segment(nothing, BOX).all()


@pytest.mark.parametrize("box", [Box(0, 0, 5, 5), Box(150, 110, 10, 10), Box(0, 0, 160, 120)])
def test_boxes_at_the_edge_of_the_picture_have_masks_of_their_size(box: Box) -> None:
    assert segment(frame(THING), box).shape == (box.height, box.width)


@pytest.mark.physics
def test_things_are_located_within_millimetres_of_the_renderers_truth() -> None:
    from sim.learning.scenes import SceneMaker
    from sim.objects.objects import load_objects

    errors = []
    with tempfile.TemporaryDirectory() as folder:
        maker = SceneMaker(load_objects(), Path(folder))
        for scene in (maker.make(20_000_000 + number) for number in range(8)):
            for index, truth in enumerate(scene.truths, start=1):
                if not truth.counts:
                    continue
                box = truth.box
                rows = slice(box.top, box.top + box.height)
                whole = scene.bodies[rows, box.left : box.left + box.width] == index
                ours, true = (
                    locate(Detection(truth.name, 1.0, box, mask), scene.frame).position
                    for mask in (segment(scene.frame, box), whole)
                )
                if true:
                    errors.append(np.linalg.norm(np.subtract(ours, true)))
        maker.close()
    assert len(errors) > 20
    assert np.median(errors) < 0.003
