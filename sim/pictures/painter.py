"""The program of the drawing process: it has a copy of a world, and draws pictures on request.

Requests come on its standard input, pixels go to its standard output, both pickled. It ends when
its input ends, that is, when the requesting process ends in any way. Of this project it imports
only what draws pictures, so that it starts fast and stays small.

For a large picture that somebody waits for, it draws every second column, while a forked process,
which shares its memory, draws the others.
"""

import os
import pickle
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, Pipe
from typing import IO, NoReturn

import numpy as np
from numpy.typing import NDArray

from sim.bullet.client import connect
from sim.bullet.rendering import View, draw, draw_part, interleaved, parts
from sim.engine import BulletClient
from sim.pictures.scene import Actors, Looks, Moment, build

PROTOCOL = 5
"""Version of pickle's protocol; this one makes no intermediate copies of arrays."""


@dataclass(frozen=True, slots=True)
class Stage:
    """The world to draw.

    Attributes:
        looks: how to build its bodies.
        bodies: ids of the movable bodies in the original world.
        robot: id of the robot there.
    """

    looks: Looks
    bodies: Sequence[int]
    robot: int


@dataclass(frozen=True, slots=True)
class Asked:
    """A request for a picture.

    Attributes:
        view: the camera's view.
        moment: poses of all that moves.
        awaited: whether somebody waits for the picture.
    """

    view: View
    moment: Moment
    awaited: bool = False


Pixels = tuple[NDArray[np.uint8], NDArray[np.float32]]
"""Colour and depth of a picture, as in `Rendering`."""


def main() -> None:
    """Draw requested pictures until the input ends."""
    try:
        _paint(sys.stdin.buffer, _private_output())
    except (EOFError, BrokenPipeError):
        os._exit(0)  # at once: there is nothing to clean up, and the parent may wait for the end


def _paint(asked: IO[bytes], answers: IO[bytes]) -> NoReturn:
    client = connect()
    stage: Stage = pickle.load(asked)
    renderer = _Renderer(client, stage)
    pair = _Pair(renderer)
    while True:
        wanted: Asked = pickle.load(asked)
        pixels = pair.draw(wanted) if wanted.awaited else renderer.draw(wanted)
        pickle.dump(pixels, answers, PROTOCOL)
        answers.flush()


class _Renderer:
    """Draws pictures in this process alone."""

    def __init__(self, client: BulletClient, stage: Stage) -> None:
        here = build(client, stage.looks)
        self._client = client
        self._actors = Actors(client, [here[body] for body in stage.bodies], here[stage.robot])

    def draw(self, wanted: Asked) -> Pixels:
        """Draw the whole picture."""
        self._actors.put(wanted.moment)
        seen = draw(self._client, wanted.view)
        return seen.color, seen.depth

    def draw_part(self, wanted: Asked) -> Pixels:
        """Draw a view in one call of the renderer: half of a large picture, or all of another."""
        self._actors.put(wanted.moment)
        seen = draw_part(self._client, wanted.view)
        return seen.color, seen.depth


class _Pair:
    """Draws large pictures in two halves at once, one in this process, one in a forked process."""

    def __init__(self, renderer: _Renderer) -> None:
        self._renderer = renderer
        self._forked, here = Pipe()
        process = None
        with suppress(OSError):  # no more processes possible: this one draws both halves
            process = os.fork()
        if process == 0:
            self._forked.close()
            self._serve(here)
        here.close()

    def draw(self, wanted: Asked) -> Pixels:
        """Draw the whole picture; by this process alone if the forked one is gone."""
        mine, *others = (replace(wanted, view=view) for view in parts(wanted.view))
        try:
            for part in others:
                self._forked.send(part)
            drawn = [self._renderer.draw_part(mine), *(self._forked.recv() for _ in others)]
        except (OSError, EOFError):
            return self._renderer.draw(wanted)
        color, depth = map(interleaved, zip(*drawn, strict=True))
        return color, depth

    def _serve(self, requests: Connection) -> NoReturn:
        """Draw the requested halves, in the forked process."""
        while True:
            requests.send(self._renderer.draw_part(requests.recv()))


def _private_output() -> IO[bytes]:
    """The former standard output; what PyBullet prints from now on goes to /dev/null."""
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
    return open(kept, "wb")
