"""Pictures of every common encoding become ours; what is not all there is refused."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.ros.packets import PacketError
from executive.ros.pictures import color_of, depth_of, lens_of


def image(encoding: str, pixels: Any, padding: int = 0, **others: Any) -> dict[str, Any]:
    height, width = pixels.shape[:2]
    rows = [row.tobytes() + b"\xff" * padding for row in pixels]
    step = len(rows[0])
    told = {"encoding": encoding, "height": height, "width": width, "step": step}
    return {**told, "data": b"".join(rows), "is_bigendian": 0, **others}


@pytest.mark.parametrize(
    ("encoding", "pixel", "rgb"),
    [
        ("rgb8", (1, 2, 3), [1, 2, 3]),
        ("bgr8", (3, 2, 1), [1, 2, 3]),
        ("rgba8", (1, 2, 3, 9), [1, 2, 3]),
        ("bgra8", (3, 2, 1, 9), [1, 2, 3]),
        ("mono8", (7,), [7, 7, 7]),
    ],
)
@given(padding=st.integers(0, 5))
def test_colors_come_as_red_green_and_blue(
    encoding: str, pixel: tuple[int, ...], rgb: list[int], padding: int
) -> None:
    pixels = np.tile(np.array(pixel, np.uint8), (2, 3, 1))
    color = color_of(image(encoding, pixels, padding))
    assert color.shape == (2, 3, 3)
    assert (color == rgb).all()


@pytest.mark.parametrize("end", ["<", ">"])
def test_depth_comes_in_metres_and_infinite_where_nothing_was_measured(end: str) -> None:
    bigendian = int(end == ">")
    millimetres = np.array([[0, 1500]], f"{end}u2")
    metres = np.array([[np.nan, 1.5]], f"{end}f4")
    for encoding, pixels in (("16UC1", millimetres), ("32FC1", metres)):
        depth = depth_of(image(encoding, pixels, is_bigendian=bigendian))
        assert depth.dtype == np.float32
        assert depth.tolist() == [[np.inf, 1.5]]


@pytest.mark.parametrize(
    "wrong",
    [
        {"encoding": "yuv422"},
        {"data": b"short"},
        {"height": 0},
        {"width": 10**6},
        {"step": 1},
        {"data": 7},
    ],
)
def test_what_is_no_picture_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(PacketError):
        color_of({**image("rgb8", np.zeros((2, 3, 3), np.uint8)), **wrong})


def test_a_lens_is_read_as_ros_1_and_ros_2_spell_it() -> None:
    k = [60.0, 0.0, 32.0, 0.0, 61.0, 24.0, 0.0, 0.0, 1.0]
    lens = lens_of({"width": 64, "height": 48, "k": k})
    assert lens == lens_of({"width": 64, "height": 48, "K": np.array(k)})
    assert (lens.fx, lens.fy, lens.cx, lens.cy) == (60.0, 61.0, 32.0, 24.0)


@pytest.mark.parametrize("middle", [None, np.inf])
def test_a_camera_that_is_not_calibrated_is_refused(middle: float | None) -> None:
    for k in ([0.0] * 9, [60.0, 0.0, middle, 0.0, 60.0, 24.0, 0.0, 0.0, 1.0]):
        with pytest.raises(PacketError, match="not calibrated"):
            lens_of({"width": 64, "height": 48, "k": k})
