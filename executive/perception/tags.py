"""Tags that spell a thing's name: how the instant world's camera shows what is in view.

A tag is a square of pixels in a colour of its own, with a rim. Inside of the rim, each channel of
each pixel is one bit: as the rim is, or brighter. They are the length of the name in bytes, the
name in UTF-8, zeros, and a checksum. Tags stand in a grid, so nobody has to look for them.
"""

import zlib
from collections.abc import Iterator
from itertools import count, takewhile

import numpy as np
from numpy.typing import NDArray

from executive.types.perception import Box, Detection, Frame

SIDE = 16
"""Of a tag (pixels)."""
MARGIN = SIDE // 2
"""Above and left of the first (pixels)."""
_INNER = SIDE - 2
_BYTES = _INNER * _INNER * 3 // 8
_SUM_BYTES = 4
LONGEST = _BYTES - 1 - _SUM_BYTES
"""So many bytes of a name have room."""
_BRIGHTER = 110


def tag(name: str) -> NDArray[np.uint8]:
    """The tag (SIDE, SIDE, 3) of a name; of one that is too long, a tag that nobody can read.

    Its colour is the first three letters of the name.
    """
    said = name.encode()
    content = bytes([len(said) % 256]) + said[:LONGEST].ljust(LONGEST, b"\0")
    bits = np.zeros(_INNER * _INNER * 3, np.uint8)
    spelled = np.unpackbits(np.frombuffer(content + _sum(content), np.uint8))
    bits[: spelled.size] = spelled
    pixels = np.empty((SIDE, SIDE, 3), np.uint8)
    pixels[:] = [letter & 0x7F for letter in said.ljust(3)[:3]]
    pixels[1:-1, 1:-1] += _BRIGHTER * bits.reshape(_INNER, _INNER, 3)
    return pixels


def read(pixels: NDArray[np.uint8]) -> str:
    """The name that a tag (SIDE, SIDE, 3) spells; empty if it is no tag."""
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
    """Where the tag with this index stands in pictures of this width, row by row."""
    row, column = divmod(index, max(1, (width - MARGIN) // SIDE))
    return Box(MARGIN + column * SIDE, MARGIN + row * SIDE, SIDE, SIDE)


def spots(width: int, height: int) -> Iterator[Box]:
    """Where tags have room in a picture of this size."""
    return takewhile(
        lambda box: box.top + SIDE <= height and box.left + SIDE <= width,
        (spot(index, width) for index in count()),
    )


def whole() -> NDArray[np.bool_]:
    """The mask of a tag."""
    return np.ones((SIDE, SIDE), np.bool_)


class TagDetector:
    """Implements Detector: reads tags, and sees nothing else."""

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """What the tags in the picture spell, all with confidence 1, row by row."""
        height, width = frame.color.shape[:2]
        found = ((read(_part(frame, box)), box) for box in spots(width, height))
        return tuple(Detection(name, 1.0, box, whole()) for name, box in found if name)


def _part(frame: Frame, box: Box) -> NDArray[np.uint8]:
    return frame.color[box.top : box.top + box.height, box.left : box.left + box.width]


def _sum(content: bytes) -> bytes:
    return zlib.crc32(content).to_bytes(_SUM_BYTES, "big")
