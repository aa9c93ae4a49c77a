"""Camera frames as JPEG."""

from functools import lru_cache

import cv2

from executive.types import Frame

JPEG_QUALITY = 90


@lru_cache(maxsize=1)
def jpeg(frame: Frame) -> bytes:
    """Encode a frame's colours; the latest one is kept, so that all sinks share one encoding."""
    bgr = cv2.cvtColor(frame.color, cv2.COLOR_RGB2BGR)
    _, encoded = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    return encoded.tobytes()
