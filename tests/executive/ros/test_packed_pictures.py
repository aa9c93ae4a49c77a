"""A camera whose pictures come as JPEG and PNG is one like any other."""

import io
import struct
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from linking import link_to
from numpy.typing import NDArray
from PIL import Image
from second_robot import HEIGHT, PROFILE, TOPICS, WIDTH, SecondRobot

from executive.events import Inbox
from executive.ros.__main__ import main
from executive.ros.offers import Offers
from executive.ros.packets import PacketError
from executive.ros.pictures import color_of, depth_of
from executive.ros.profile import COMPRESSED
from executive.ros.proposing import proposal
from executive.testing.bench import four_rooms
from executive.testing.contracts.camera import CameraBench, CameraContract

MILLIMETRES = np.array([[0, 1500, 65535]], np.uint16)


def packed(pixels: NDArray[Any], kind: str = "png") -> bytes:
    out = io.BytesIO()
    Image.fromarray(pixels).save(out, kind)
    return out.getvalue()


def with_header(png: bytes, factor: float = 0.0, offset: float = 0.0) -> bytes:
    """As compressed_depth_image_transport has it."""
    return struct.pack("<iff", 1, factor, offset) + png


def depth(data: bytes, kind: str = "16UC1; compressedDepth png") -> list[list[float]]:
    return depth_of({"format": kind, "data": data}).tolist()


class PackedRobot(SecondRobot):
    topics = {**TOPICS, "/acme/rgb": COMPRESSED, "/acme/range": COMPRESSED}

    def _color(self) -> dict[str, Any]:
        pixels = np.full((HEIGHT, WIDTH, 3), (0, 0, 200), np.uint8)
        said = {"format": "rgb8; jpeg compressed bgr8", "data": packed(pixels, "jpeg")}
        return {"header": self._header("eye"), **said}

    def _range(self) -> dict[str, Any]:
        told = super()._range()
        rows = np.frombuffer(told["data"], "<u2").reshape(HEIGHT, -1)[:, :WIDTH]
        said = {"format": "16UC1; compressedDepth png", "data": with_header(packed(rows))}
        return {"header": told["header"], **said}


@pytest.fixture
def there() -> Iterator[PackedRobot]:
    with PackedRobot(four_rooms().robot_start) as robot:
        yield robot


@pytest.fixture
def profile(tmp_path: Path) -> Path:
    file = tmp_path / "packed.toml"
    both = '[camera]\ncompressed = ["color", "depth"]'
    file.write_text(PROFILE.read_text().replace("[camera]", both))
    return file


class TestPackedCamera(CameraContract):
    @pytest.fixture
    def camera_bench(self, there: PackedRobot, profile: Path) -> Iterator[CameraBench]:
        with link_to(there.url, Inbox(), profile) as here:
            x, y, _ = there.at
            yield CameraBench(here.camera, robot_at=(x, y))

    def test_blue_comes_as_blue(self, camera_bench: CameraBench) -> None:
        red, green, blue = camera_bench.camera.capture().color[0, 0].tolist()
        assert (red, green) == pytest.approx((0, 0), abs=8)
        assert blue == pytest.approx(200, abs=8)


def test_a_profile_that_does_not_say_so_is_told_what_would_be_right(
    there: PackedRobot, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", there.url, "--profile", str(PROFILE)]) == 2
    said = capsys.readouterr().err
    assert f"camera.color: /acme/rgb is of type {COMPRESSED}" in said
    assert 'write compressed = ["color"] in [camera]' in said
    assert 'write compressed = ["depth"] in [camera]' in said


def test_a_profile_that_says_so_of_plain_pictures_is_told_what_would_be_right(
    profile: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with SecondRobot() as robot:
        assert main(["check", robot.url, "--profile", str(profile)]) == 2
    assert "leave color out of camera.compressed" in capsys.readouterr().err


def camera_of(topics: dict[str, str]) -> dict[str, Any]:
    """What is proposed."""
    return tomllib.loads(proposal(Offers(topics), ()))["camera"]


def test_what_is_packed_is_proposed_where_there_is_nothing_else() -> None:
    transports = ("compressed", "compressedDepth", "zstd")
    offered = {f"/eye/{of}/{how}": COMPRESSED for of in ("color", "depth") for how in transports}
    camera = camera_of(offered)
    assert camera["color"] == "/eye/color/compressed"
    assert camera["depth"] == "/eye/depth/compressedDepth"
    assert camera["compressed"] == ["color", "depth"]
    camera = camera_of({**offered, "/eye/depth/image": "sensor_msgs/msg/Image"})
    assert camera["depth"] == "/eye/depth/image"
    assert camera["compressed"] == ["color"]


@pytest.mark.parametrize("kind", ["png", "jpeg"])
@pytest.mark.parametrize("shape", [(2, 3), (2, 3, 3)])
def test_colors_come_as_red_green_and_blue(kind: str, shape: tuple[int, ...]) -> None:
    color = color_of({"format": kind, "data": packed(np.full(shape, 90, np.uint8), kind)})
    assert color.shape == (2, 3, 3)
    assert color.astype(int) == pytest.approx(90, abs=2)


@pytest.mark.parametrize("kind", ["16UC1; compressedDepth png", "16UC1; compressedDepth"])
def test_millimetres_come_as_metres(kind: str) -> None:
    found = depth(with_header(packed(MILLIMETRES)), kind)
    assert found == [pytest.approx([np.inf, 1.5, 65.535])]


def test_depth_as_a_png_alone_is_in_millimetres() -> None:
    assert depth(packed(MILLIMETRES), "png") == [pytest.approx([np.inf, 1.5, 65.535])]


def test_what_is_inverse_to_metres_comes_as_metres() -> None:
    """As the transport's own `encodeCompressedDepthImage` packs it, to 0.1 m at 10 m."""
    quality, furthest = 100.0, 10.0
    factor = quality * (quality + 1)
    offset = 1 - factor / furthest
    metres = np.array([[0.5, 2.0, 9.0]], np.float32)
    inverse = packed((factor / metres + offset).astype(np.uint16))
    found = depth(with_header(inverse, factor, offset), "32FC1; compressedDepth png")
    assert found == [pytest.approx([0.5, 2.0, 9.0], rel=0.01)]
    nothing = packed(np.zeros((1, 1), np.uint16))
    assert depth(with_header(nothing, factor, offset), "32FC1; compressedDepth png") == [[np.inf]]


@pytest.mark.parametrize(
    ("data", "kind"),
    [
        (with_header(b"\x00\x01"), "16UC1; compressedDepth rvl"),
        (with_header(packed(MILLIMETRES)), "64FC1; compressedDepth png"),
        (packed(MILLIMETRES.astype(np.uint8)), "16UC1; png compressed"),
        (packed(MILLIMETRES.astype(np.uint8), "jpeg"), "16UC1; jpeg compressed"),
        (packed(MILLIMETRES), "32FC1; png compressed"),
        (with_header(packed(MILLIMETRES)[:50]), "16UC1; compressedDepth png"),
        (b"", "16UC1; compressedDepth png"),
    ],
)
def test_what_is_no_packed_depth_is_refused(data: bytes, kind: str) -> None:
    with pytest.raises(PacketError, match="a compressed"):
        depth(data, kind)


@pytest.mark.parametrize(
    "data",
    [b"", b"GIF89a", packed(np.zeros((9, 9, 3), np.uint8))[:45], packed(MILLIMETRES)],
)
def test_what_is_no_packed_color_is_refused(data: bytes) -> None:
    with pytest.raises(PacketError, match="a compressed|a colour picture"):
        color_of({"format": "png", "data": data})


def test_a_picture_that_would_be_too_large_is_not_unpacked() -> None:
    large = packed(np.zeros((4000, 4000), np.uint8))
    with pytest.raises(PacketError, match="4000 x 4000 pixels: that is too large"):
        color_of({"format": "png", "data": large})
