"""Pictures as files."""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray


def png(color: NDArray[np.uint8]) -> bytes:
    """An RGB picture (height, width, 3) as a PNG file (ISO/IEC 15948)."""
    height, width, _ = color.shape
    rows = np.concatenate((np.zeros((height, 1), np.uint8), color.reshape(height, -1)), axis=1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes())), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in chunks
    )
