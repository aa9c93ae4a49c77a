"""The process that draws: it has a copy of a world, and makes pictures of it when it is asked.

It is spoken to over its standard input, and answers over its standard output. When the input ends,
because the process that asked is over, however that came, it ends, too. Of ours it imports nothing
that draws no pictures: it begins fast, and stays small.
"""

import os
import pickle
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import IO, NoReturn

import numpy as np
from numpy.typing import NDArray

from sim.bullet.client import connect
from sim.bullet.rendering import View, draw
from sim.pictures.scene import Actors, Moment, Step, build

PROTOCOL = 5
"""Of pickle: arrays are sent as they are."""


@dataclass(frozen=True, slots=True)
class Stage:
    """What there is in the world, and what of it moves."""

    steps: Sequence[Step]
    bodies: Sequence[int]
    robot: int


@dataclass(frozen=True, slots=True)
class Asked:
    """A picture that is wanted, of a moment."""

    view: View
    moment: Moment


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
    build(client, stage.steps)
    actors = Actors(client, stage.bodies, stage.robot)
    while True:
        wanted: Asked = pickle.load(asked)
        actors.put(wanted.moment)
        seen = draw(client, wanted.view)
        pickle.dump((seen.color, seen.depth), answers, PROTOCOL)
        answers.flush()


def _private_output() -> IO[bytes]:
    """What was standard output; whatever PyBullet prints there from now on goes nowhere."""
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
    return open(kept, "wb")
