"""How a process deals with its heap. It changes nothing but how long things take."""

import ctypes
from contextlib import suppress

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
"""Of `mallopt`, in glibc's malloc.h."""
PICTURES_BYTES = 8 << 20
"""The largest block that is kept: pictures of 640x480 with depth are 2 MiB."""
KEPT_BYTES = 32 << 20


def keep_what_is_freed() -> None:
    """Take the memory of a picture for the next one, instead of giving it back in between.

    The system fills each page with zeros that it hands out, which costs more than to copy a picture
    there. Does nothing where the C library is another one than glibc.
    """
    with suppress(AttributeError, OSError, TypeError):
        mallopt = ctypes.CDLL(None).mallopt
        mallopt(_MMAP_THRESHOLD, PICTURES_BYTES)
        mallopt(_TRIM_THRESHOLD, KEPT_BYTES)
