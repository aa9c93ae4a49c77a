"""The process that draws: it has a copy of a world, and makes pictures of it when it is asked.

It is spoken to over its standard input, and answers over its standard output. When the input ends,
because the process that asked is over, however that came, it ends, too. Of ours it imports nothing
that draws no pictures: it begins fast, and stays small.

Of a large picture that somebody waits for it draws one part, and a process that is forked off it,
and shares its memory, draws the other at the same time.
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
"""Of pickle: arrays are sent as they are."""


@dataclass(frozen=True, slots=True)
class Stage:
    """What there is in the world, and what of it moves, by its ids there."""

    looks: Looks
    bodies: Sequence[int]
    robot: int


@dataclass(frozen=True, slots=True)
class Asked:
    """A picture that is wanted, of a moment.

    Attributes:
        view: what it shows.
        moment: when.
        awaited: whether somebody waits for it.
    """

    view: View
    moment: Moment
    awaited: bool = False


Pixels = tuple[NDArray[np.uint8], NDArray[np.float32]]
"""Colour and depth of a picture, as a `Rendering` has them."""


def main() -> None:
    """Draw what is asked for until the input ends."""
    try:
        _paint(sys.stdin.buffer, _private_output())
    except (EOFError, BrokenPipeError):
        os._exit(0)  # at once: there is nothing to put in order, and somebody may wait for it


def _paint(asked: IO[bytes], answers: IO[bytes]) -> NoReturn:
    client = connect()
    stage: Stage = pickle.load(asked)
    easel = _Easel(client, stage)
    twin = _Twin(easel)
    while True:
        wanted: Asked = pickle.load(asked)
        pixels = twin.draw(wanted) if wanted.awaited else easel.draw(wanted)
        pickle.dump(pixels, answers, PROTOCOL)
        answers.flush()


class _Easel:
    """Where pictures are drawn by one process."""

    def __init__(self, client: BulletClient, stage: Stage) -> None:
        here = build(client, stage.looks)
        self._client = client
        self._actors = Actors(client, [here[body] for body in stage.bodies], here[stage.robot])

    def draw(self, wanted: Asked) -> Pixels:
        """All of it."""
        self._actors.put(wanted.moment)
        seen = draw(self._client, wanted.view)
        return seen.color, seen.depth

    def draw_part(self, wanted: Asked) -> Pixels:
        """What is drawn in one go."""
        self._actors.put(wanted.moment)
        seen = draw_part(self._client, wanted.view)
        return seen.color, seen.depth


class _Twin:
    """A process that is forked off this one, and draws the second part of a picture meanwhile."""

    def __init__(self, easel: _Easel) -> None:
        self._easel = easel
        self._twin, here = Pipe()
        process = None
        with suppress(OSError):  # no more processes: this one draws both parts
            process = os.fork()
        if process == 0:
            self._twin.close()
            self._help(here)
        here.close()

    def draw(self, wanted: Asked) -> Pixels:
        """What the easel would show, sooner; by the easel alone, if the twin is gone."""
        mine, *others = (replace(wanted, view=view) for view in parts(wanted.view))
        try:
            for part in others:
                self._twin.send(part)
            drawn = [self._easel.draw_part(mine), *(self._twin.recv() for _ in others)]
        except (OSError, EOFError):
            return self._easel.draw(wanted)
        color, depth = map(interleaved, zip(*drawn, strict=True))
        return color, depth

    def _help(self, asked: Connection) -> NoReturn:
        while True:
            asked.send(self._easel.draw_part(asked.recv()))


def _private_output() -> IO[bytes]:
    """What was standard output; whatever PyBullet prints there from now on goes nowhere."""
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
    return open(kept, "wb")
