"""The physics engine, PyBullet; all other modules import it from here.

PyBullet prints a line on standard error when it is imported; this module suppresses it.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress

STDERR = 2
GREETING = b"pybullet build time:"


@contextmanager
def _without_greeting() -> Iterator[None]:
    """Buffer standard error, and write it out afterwards without PyBullet's greeting."""
    try:
        kept = os.dup(STDERR)
    except OSError:  # standard error is closed
        yield
        return
    said, hold = os.pipe()
    os.set_blocking(hold, False)  # a full pipe must not block: we read it only afterwards
    os.dup2(hold, STDERR)
    try:
        yield
    finally:
        os.dup2(kept, STDERR)
        os.close(kept)
        os.close(hold)
        with open(said, "rb") as lines, suppress(OSError):
            os.write(STDERR, b"".join(line for line in lines if not line.startswith(GREETING)))


with _without_greeting():
    import pybullet
    from pybullet_utils.bullet_client import BulletClient

__all__ = ["BulletClient", "pybullet"]
