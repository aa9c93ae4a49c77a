"""`sensor_msgs/CompressedImage`: JPEG and PNG; depth as `compressed_depth_image_transport` has it.

There a header stands before a PNG with 16 bits for each pixel: millimetres, or, of depth that was
in metres, what is inverse to it, with the two numbers that turn it back.
"""

import io
import struct
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from executive.ros.packets import FEW, MOST_BYTES, PacketError, octets
from executive.ros.protocol import Message

METRES = "32FC1"
"""What the pixels were before they were packed, first in `format`."""
_MILLIMETRES = ("16UC1", "mono16", "png", "")
_SHADES = ("L", "RGB", "RGBA", "P")
"""What JPEG and PNG have as colours, in Pillow's words."""
_HEADER = struct.Struct("<iff")
_PNG = b"\x89PNG\r\n\x1a\n"
_PIXEL_BYTES = 3


def unpacked_color(message: Message) -> NDArray[np.uint8]:
    """The picture as (height, width, 3), RGB.

    Raises:
        PacketError: if it is none.
    """
    with _opened(octets(message["data"]), ("JPEG", "PNG")) as picture:
        if picture.mode not in _SHADES:
            raise PacketError(f"a colour picture whose pixels are {picture.mode}")
        return np.asarray(picture.convert("RGB"))


def unpacked_depth(message: Message) -> NDArray[np.float32]:
    """Depth as (height, width) in metres; 0 where nothing was measured.

    Raises:
        PacketError: if it is none.
    """
    data, said = octets(message["data"]), str(message["format"])
    kind = said.partition(";")[0].strip()
    begins = 0 if data.startswith(_PNG) else _HEADER.size
    if not data.startswith(_PNG, begins) or kind not in (*_MILLIMETRES, METRES):
        raise PacketError(
            f"a compressed depth picture of format {said[:60]!r}; I read 16UC1 and 32FC1 as png"
        )
    with _opened(data[begins:], ("PNG",)) as picture:
        if picture.mode != "I;16":
            raise PacketError("a compressed depth picture that has not 16 bits for each pixel")
        packed = np.asarray(picture).astype(np.float32)
    if kind != METRES:
        return packed / np.float32(1000)
    if not begins:
        raise PacketError("a compressed depth picture without what turns it into metres")
    _, factor, offset = _HEADER.unpack_from(data)
    with np.errstate(divide="ignore", invalid="ignore"):
        metres = np.float32(factor) / (packed - np.float32(offset))
    return np.where(packed > 0, metres, np.float32(0))


@contextmanager
def _opened(content: bytes, formats: tuple[str, ...]) -> Iterator[Image.Image]:
    try:
        with Image.open(io.BytesIO(content), formats=formats) as picture:
            if picture.width * picture.height * _PIXEL_BYTES > MOST_BYTES:
                size = f"{picture.width} x {picture.height}"
                raise PacketError(f"a compressed picture of {size} pixels: that is too large")
            yield picture
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise PacketError(f"a compressed picture that cannot be read: {str(error)[:FEW]}") from None
