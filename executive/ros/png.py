"""Rosbridge's compression `png`: a message's text as the pixels of a picture, in base64."""

import base64
import binascii
import io
import math
import struct

from PIL import Image

from executive.ros.packets import FEW, MOST_BYTES, PacketError

_CHANNELS = 3
_SIZE, _SIZE_AT = struct.Struct(">II"), 16
"""Width and height, where each PNG has them."""
_FILLS_UP = b"\n"
"""JSON may end with it."""


def to_png(text: str) -> str:
    """The text as a square picture, in base64."""
    content = text.encode()
    width = max(1, math.isqrt(len(content) // _CHANNELS))
    height = max(1, math.ceil(len(content) / (_CHANNELS * width)))
    pixels = content.ljust(_CHANNELS * width * height, _FILLS_UP)
    out = io.BytesIO()
    Image.frombytes("RGB", (width, height), pixels).save(out, "png", compress_level=1)
    return base64.b64encode(out.getvalue()).decode("ascii")


def from_png(data: object) -> str:
    """The text again.

    Raises:
        PacketError: if it is none, or too long.
    """
    if not isinstance(data, str):
        raise PacketError("a png whose data is no text")
    try:
        content = base64.b64decode(data, validate=True)
        width, height = _SIZE.unpack_from(content, _SIZE_AT)
        if _CHANNELS * width * height > MOST_BYTES:
            raise PacketError(f"a png of {width} x {height} pixels: that is too long")
        with Image.open(io.BytesIO(content), formats=("PNG",)) as picture:
            return picture.convert("RGB").tobytes().rstrip(_FILLS_UP).decode()
    except (binascii.Error, struct.error, ValueError, OSError, SyntaxError) as error:
        raise PacketError(f"a png that cannot be read: {str(error)[:FEW]}") from None
