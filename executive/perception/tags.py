"""Tags that encode the name of a thing: the pictures of the instant world's camera.

A tag is a square of pixels in one colour, with a rim. Inside the rim, each channel of each pixel is
one bit: as the rim, or brighter. The bits are the length of the name in bytes, the name in UTF-8,
zeros, and a checksum. Tags are in a fixed grid, so that they need not be searched.
"""

import zlib
from collections.abc import Iterator
from itertools import count, takewhile

import numpy as np
from numpy.typing import NDArray

from executive.types.perception import Box, Detection, Frame

SIDE = 16
"""Side of a tag (pixels)."""
MARGIN = SIDE // 2
"""Margin above and left of the first tag (pixels)."""
_INNER = SIDE - 2
_BYTES = _INNER * _INNER * 3 // 8
_SUM_BYTES = 4
LONGEST = _BYTES - 1 - _SUM_BYTES
"""The largest length of a name (bytes)."""
_BRIGHTER = 110


def tag(name: str) -> NDArray[np.uint8]:
    """The tag (SIDE, SIDE, 3) of a name of at most `LONGEST` bytes, in UTF-8.

    The colour of its rim comes from the first three letters of the name. `read` refuses the tag of
    a longer name.
    """
    said = name.encode()
    content = bytes([min(len(said), 255)]) + said[:LONGEST].ljust(LONGEST, b"\0")
    bits = np.zeros(_INNER * _INNER * 3, np.uint8)
    spelled = np.unpackbits(np.frombuffer(content + _sum(content), np.uint8))
    bits[: spelled.size] = spelled
    pixels = np.empty((SIDE, SIDE, 3), np.uint8)
    pixels[:] = [letter & 0x7F for letter in said.ljust(3)[:3]]
    pixels[1:-1, 1:-1] += _BRIGHTER * bits.reshape(_INNER, _INNER, 3)
    return pixels


def read(pixels: NDArray[np.uint8]) -> str:
    """The name in a tag (SIDE, SIDE, 3); empty if it is not a tag."""
    rim = np.ones((SIDE, SIDE), np.bool_)
    rim[1:-1, 1:-1] = False
    dark = np.median(pixels[rim], axis=0)
    bits = (pixels[1:-1, 1:-1] > dark + _BRIGHTER / 2).ravel()[: 8 * _BYTES]
    content = np.packbits(bits).tobytes()
    length = content[0]
    if not 0 < length <= LONGEST or content[-_SUM_BYTES:] != _sum(content[:-_SUM_BYTES]):
        return ""
    return content[1 : 1 + length].decode(errors="replace")


def spot(index: int, width: int) -> Box:
    """The position of the tag with this index in pictures of this width, row by row."""
    row, column = divmod(index, max(1, (width - MARGIN) // SIDE))
    return Box(MARGIN + column * SIDE, MARGIN + row * SIDE, SIDE, SIDE)


def spots(width: int, height: int) -> Iterator[Box]:
    """All positions of tags in a picture of this size."""
    return takewhile(
        lambda box: box.top + SIDE <= height and box.left + SIDE <= width,
        (spot(index, width) for index in count()),
    )


def whole() -> NDArray[np.bool_]:
    """The mask of a tag: all its pixels."""
    return np.ones((SIDE, SIDE), np.bool_)


class TagDetector:
    """Implements `Detector`: recognises tags only."""

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """The names in the tags of the picture, with confidence 1, row by row."""
        height, width = frame.color.shape[:2]
        found = ((read(_part(frame, box)), box) for box in spots(width, height))
        return tuple(Detection(name, 1.0, box, whole()) for name, box in found if name)


def _part(frame: Frame, box: Box) -> NDArray[np.uint8]:
    return frame.color[box.top : box.top + box.height, box.left : box.left + box.width]


def _sum(content: bytes) -> bytes:
    return zlib.crc32(content).to_bytes(_SUM_BYTES, "big")
