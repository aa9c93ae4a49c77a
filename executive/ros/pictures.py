"""`sensor_msgs/Image`, `CompressedImage` and `CameraInfo` to our pictures."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from executive.ros.compressed import METRES, unpacked_color, unpacked_depth
from executive.ros.packets import PacketError, numbers, octets
from executive.ros.protocol import Message
from executive.types.perception import Intrinsics

COLORS = {
    "rgb8": (3, (0, 1, 2)),
    "bgr8": (3, (2, 1, 0)),
    "rgba8": (4, (0, 1, 2)),
    "bgra8": (4, (2, 1, 0)),
    "8UC3": (3, (2, 1, 0)),
    "mono8": (1, (0, 0, 0)),
    "8UC1": (1, (0, 0, 0)),
}
"""Encoding: bytes of a pixel, and which of them are red, green and blue."""
MILLIMETRES = ("16UC1", "mono16")
LARGEST = 8192
"""Pixels in a row or column."""


def color_of(message: Message) -> NDArray[np.uint8]:
    """The picture as (height, width, 3), RGB.

    Raises:
        PacketError: if it is of another kind, or is not all there.
    """
    if "format" in message:
        return unpacked_color(message)
    encoding = str(message["encoding"])
    if encoding not in COLORS:
        known = ", ".join(COLORS)
        raise PacketError(f"a colour picture with encoding {encoding[:20]!r}; I read {known}")
    channels, order = COLORS[encoding]
    pixels = _rows(message, np.dtype(np.uint8), channels)
    if order == tuple(range(channels)):
        return pixels
    return np.ascontiguousarray(pixels[:, :, list(order)])


def depth_of(message: Message) -> NDArray[np.float32]:
    """Depth as (height, width) in metres, infinite where nothing was measured.

    Raises:
        PacketError: if it is of another kind, or is not all there.
    """
    measured = unpacked_depth(message) if "format" in message else _plain_depth(message)
    return np.where(measured > 0, measured, np.float32(np.inf)).astype(np.float32)


def _plain_depth(message: Message) -> NDArray[np.float32]:
    """In metres."""
    encoding = str(message["encoding"])
    end = ">" if message.get("is_bigendian") else "<"
    if encoding in MILLIMETRES:
        millimetres = _rows(message, np.dtype(f"{end}u2"), 1)[:, :, 0]
        return millimetres.astype(np.float32) / np.float32(1000)
    if encoding == METRES:
        return _rows(message, np.dtype(f"{end}f4"), 1)[:, :, 0].astype(np.float32)
    known = ", ".join((*MILLIMETRES, METRES))
    raise PacketError(f"a depth picture with encoding {encoding[:20]!r}; I read {known}")


def _rows(message: Message, kind: np.dtype[Any], channels: int) -> NDArray[Any]:
    """The pixels as (height, width, channels), without what fills up the rows."""
    height, width = int(message["height"]), int(message["width"])
    row = width * channels * kind.itemsize
    step = int(message.get("step") or row)
    data = octets(message["data"])
    if not (0 < height <= LARGEST and 0 < width <= LARGEST and step >= row):
        raise PacketError(f"a picture of {width} x {height} pixels with rows of {step} bytes")
    if len(data) < step * (height - 1) + row:
        raise PacketError(f"a picture of {len(data)} bytes that lacks some of its {height} rows")
    data = data.ljust(step * height, b"\0")
    lines = np.frombuffer(data, np.uint8, step * height).reshape(height, step)[:, :row]
    return np.ascontiguousarray(lines).view(kind).reshape(height, width, channels)


def lens_of(message: Message) -> Intrinsics:
    """The camera's intrinsics, of pictures that are rectified.

    Raises:
        PacketError: if they cannot be.
    """
    k = numbers(message["k"] if "k" in message else message["K"])
    width, height = int(message["width"]), int(message["height"])
    whole = len(k) == 9 and all(map(math.isfinite, k))
    if not (whole and k[0] > 0 and k[4] > 0 and width > 0 and height > 0):
        raise PacketError("a CameraInfo of a camera that is not calibrated")
    return Intrinsics(width, height, k[0], k[4], k[2], k[5])
