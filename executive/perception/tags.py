"""Tags that spell a thing's name: how the instant world's camera shows what is in view.

A tag is a square of pixels. Each colour of each pixel is dark or bright, which is one bit: first
the length of the name in bytes, then the name in UTF-8, then zeros, and at last a checksum. Tags
stand in a grid, so that nobody has to look for them.
"""

import zlib
from collections.abc import Iterator
from itertools import count, takewhile

import numpy as np
from numpy.typing import NDArray

from executive.types import Box, Detection, Frame

SIDE = 16
"""Of a tag (pixels)."""
MARGIN = SIDE // 2
"""Above and left of the first (pixels)."""
_DARK, _BRIGHT, _BETWEEN = 60, 200, 128
_BYTES = SIDE * SIDE * 3 // 8
_SUM_BYTES = 4
LONGEST = _BYTES - 1 - _SUM_BYTES
"""So many bytes of a name have room."""


def tag(name: str) -> NDArray[np.uint8]:
    """The tag (SIDE, SIDE, 3) of a name; of one that is too long, a tag that nobody can read."""
    said = name.encode()[:LONGEST]
    content = bytes([len(name.encode()) % 256]) + said.ljust(LONGEST, b"\0")
    bits = np.unpackbits(np.frombuffer(content + _sum(content), np.uint8))
    return np.where(bits, _BRIGHT, _DARK).astype(np.uint8).reshape(SIDE, SIDE, 3)


def spot(index: int, width: int) -> Box:
    """Where the tag with this index stands in pictures of this width, row by row."""
    row, column = divmod(index, max(1, (width - MARGIN) // SIDE))
    return Box(MARGIN + column * SIDE, MARGIN + row * SIDE, SIDE, SIDE)


def spots(width: int, height: int) -> Iterator[Box]:
    """Where tags have room in a picture of this size."""
    return takewhile(
        lambda box: box.top + SIDE <= height and box.left + SIDE <= width,
        (spot(index, width) for index in count()),
    )


def read(pixels: NDArray[np.uint8]) -> str:
    """The name that a tag spells; empty if it is no tag."""
    content = np.packbits(pixels.ravel() > _BETWEEN).tobytes()
    length = content[0]
    if not 0 < length <= LONGEST or content[-_SUM_BYTES:] != _sum(content[:-_SUM_BYTES]):
        return ""
    return content[1 : 1 + length].decode(errors="replace")


class TagDetector:
    """Implements Detector: reads tags, and sees nothing else."""

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """What the tags in the picture spell, all with confidence 1, row by row."""
        height, width = frame.color.shape[:2]
        found = ((read(_part(frame, box)), box) for box in spots(width, height))
        return tuple(Detection(name, 1.0, box, whole()) for name, box in found if name)


def _part(frame: Frame, box: Box) -> NDArray[np.uint8]:
    return frame.color[box.top : box.top + box.height, box.left : box.left + box.width]


def whole() -> NDArray[np.bool_]:
    """The mask of a tag."""
    return np.ones((SIDE, SIDE), np.bool_)


def _sum(content: bytes) -> bytes:
    return zlib.crc32(content).to_bytes(_SUM_BYTES, "big")
