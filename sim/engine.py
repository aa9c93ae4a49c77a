"""The physics engine, PyBullet. Who needs it takes it from here.

Its library prints a line on standard error when it is imported, which no command should begin with.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress

STDERR = 2
GREETING = b"pybullet build time:"


@contextmanager
def _without_greeting() -> Iterator[None]:
    """What is written to standard error meanwhile comes afterwards, less the greeting."""
    try:
        kept = os.dup(STDERR)
    except OSError:  # it is closed: nobody hears anything
        yield
        return
    said, hold = os.pipe()
    os.set_blocking(hold, False)  # never wait for a reader: it is us
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
