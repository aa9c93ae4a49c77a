"""Opens a PyBullet world, and keeps PyBullet's own messages off stdout, which is for results."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from inspect import isbuiltin

from executive.heap import keep_what_is_freed
from sim.engine import BulletClient
from sim.engine import pybullet as p

GRAVITY_M_S2 = 9.81


def connect(gui: bool = False) -> BulletClient:
    """Open an empty world with gravity in this process; `gui` also opens PyBullet's window."""
    keep_what_is_freed()
    with _without_stdout():
        client = BulletClient(p.GUI if gui else p.DIRECT)
    for name, function in vars(p).items():
        if isbuiltin(function) and name != "disconnect":
            # For speed: BulletClient itself looks up the function again at each call.
            setattr(client, name, partial(function, physicsClientId=client._client))
    client.setGravity(0.0, 0.0, -GRAVITY_M_S2)
    return client


def aim_window(client: BulletClient, corners: tuple[float, float, float, float]) -> None:
    """Aim the camera of PyBullet's window at a part of `map`: left, lower, right, upper (m)."""
    left, lower, right, upper = corners
    client.configureDebugVisualizer(p.COV_ENABLE_GUI, 0)
    client.resetDebugVisualizerCamera(
        cameraDistance=max(right - left, upper - lower),
        cameraYaw=0.0,
        cameraPitch=-65.0,
        cameraTargetPosition=((left + right) / 2, (lower + upper) / 2, 0.0),
    )


@contextmanager
def _without_stdout() -> Iterator[None]:
    """Redirect file descriptor 1 to /dev/null: PyBullet's C code prints its arguments there."""
    if sys.stdout is not None:
        sys.stdout.flush()
    try:
        kept = os.dup(1)
    except OSError:  # it is closed
        yield
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)
