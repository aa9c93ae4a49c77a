"""Camera frames as JPEG."""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from executive.types.perception import Frame

JPEG_QUALITY = 90


@lru_cache(maxsize=1)
def jpeg(frame: Frame) -> bytes:
    """Encode a frame's colours; caches the latest one, so that all sinks share one encoding."""
    return _encoded(frame.color)


def jpeg_scaled(frame: Frame, factor: float) -> bytes:
    """Encode a frame's colours, scaled to `factor` times as many pixels in each direction."""
    if factor == 1.0:
        return jpeg(frame)
    scaled = cv2.resize(frame.color, None, fx=factor, fy=factor)
    return _encoded(np.asarray(scaled, np.uint8))


def _encoded(color: NDArray[np.uint8]) -> bytes:
    bgr = cv2.cvtColor(color, cv2.COLOR_RGB2BGR)
    _, encoded = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    return encoded.tobytes()
