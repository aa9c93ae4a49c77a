"""Opening a PyBullet world without its chatter on stdout, where only results belong."""

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
    """An empty world with gravity, computed in this process; `gui` opens PyBullet's own window."""
    keep_what_is_freed()
    with _without_stdout():
        client = BulletClient(p.GUI if gui else p.DIRECT)
    for name, function in vars(p).items():
        if isbuiltin(function) and name != "disconnect":
            # The client itself looks each function up anew, whenever one is called.
            setattr(client, name, partial(function, physicsClientId=client._client))
    client.setGravity(0.0, 0.0, -GRAVITY_M_S2)
    return client


def aim_window(client: BulletClient, corners: tuple[float, float, float, float]) -> None:
    """Have PyBullet's own window look down on left, lower, right, upper of `map` (metres)."""
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
    """PyBullet's C code prints its arguments: send the descriptor nowhere meanwhile."""
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
