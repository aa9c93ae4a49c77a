"""Tuning of the process's heap; it only affects speed."""

import ctypes
from contextlib import suppress

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
"""Parameters of `mallopt`, from glibc's malloc.h."""
PICTURES_BYTES = 8 << 20
"""The largest block that is kept for reuse: pictures of 640x480 with depth are 2 MiB."""
KEPT_BYTES = 32 << 20


def keep_what_is_freed() -> None:
    """Reuse the memory of a picture for the next one, instead of returning it to the system.

    The system fills each new page with zeros, which takes longer than copying a picture there.
    Does nothing if the C library is not glibc.
    """
    with suppress(AttributeError, OSError, TypeError):
        mallopt = ctypes.CDLL(None).mallopt
        mallopt(_MMAP_THRESHOLD, PICTURES_BYTES)
        mallopt(_TRIM_THRESHOLD, KEPT_BYTES)
