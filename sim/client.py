"""Opening a PyBullet world without its chatter on stdout, where only results belong."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pybullet as p
from pybullet_utils.bullet_client import BulletClient

GRAVITY_M_S2 = 9.81


def connect(gui: bool = False) -> BulletClient:
    """An empty world with gravity, computed in this process; `gui` opens PyBullet's own window."""
    with _stdout_to_stderr():
        client = BulletClient(p.GUI if gui else p.DIRECT)
    client.setGravity(0.0, 0.0, -GRAVITY_M_S2)
    return client


@contextmanager
def _stdout_to_stderr() -> Iterator[None]:
    """PyBullet's C code prints its arguments: send the descriptor elsewhere meanwhile."""
    sys.stdout.flush()
    kept = os.dup(1)
    os.dup2(2, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
