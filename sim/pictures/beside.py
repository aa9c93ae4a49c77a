"""Pictures that are drawn beside the physics, by a process with its own copy of the world.

A world has one such process at most, for those of the log and for what the robot looks at. What it
draws is the same, but for a pixel now and then in which two surfaces are equally far: a frame's
pixels come later. For those of the log nobody waits; for what the robot looks at the mission waits,
but a stop is heard meanwhile. Where there is no such process, or too much waits for it, pictures
are drawn here and at once.
"""

import logging
import multiprocessing
import os

from executive.interfaces.runtime import Recorder
from executive.records import Note
from executive.text import printable
from executive.types.perception import Frame
from sim.bullet.camera import SimulatedCamera, view_from
from sim.pictures.coming import ComingFrame
from sim.pictures.painter import Asked, Stage
from sim.pictures.process import Painter
from sim.pictures.scene import Actors, Blueprint

log = logging.getLogger(__name__)


def worthwhile() -> bool:
    """Whether a second process has a core of its own; the workers of a pool share theirs."""
    return _cores() > 1 and multiprocessing.parent_process() is None


def _cores() -> int:
    """Those that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Beside:
    """The process of one world, which draws what any camera in it sees, as long as it can."""

    def __init__(self, actors: Actors, blueprint: Blueprint, recorder: Recorder) -> None:
        """Start it.

        Args:
            actors: what moves in the world.
            blueprint: of the world, which is built.
            recorder: is told when the process draws no more.
        """
        self._actors = actors
        self._recorder = recorder
        self._painter: Painter | None = None
        self._untold = ""
        """Why there is no painter, until that is told."""
        stage = Stage(blueprint.looks, actors.bodies, actors.robot)
        try:
            self._painter = Painter(stage)
        except (OSError, RuntimeError) as error:  # no process, or no thread, is to be had
            self._untold = f"no process can be started for them: {error}"

    def draw(self, camera: SimulatedCamera, *, awaited: bool) -> Frame | None:
        """The picture of this moment, which will come; None if it has to be drawn here."""
        coming = self._coming(camera, awaited)
        if self._untold:
            text = printable(f"pictures are not drawn beside the physics: {self._untold}")
            log.warning("%s", text)
            self._recorder.record(Note("warning", text))
            self._untold = ""
        return coming

    def _coming(self, camera: SimulatedCamera, awaited: bool) -> Frame | None:
        if self._painter is None:
            return None
        pose, lens = camera.pose(), camera.lens
        pixels = self._painter.paint(Asked(view_from(pose, lens), self._actors.where(), awaited))
        if pixels is not None:
            return ComingFrame(next(camera.numbers), lens, pose, pixels)
        if self._painter.failure:
            self._untold = self._painter.failure
            self.close()
        return None

    def close(self) -> None:
        """Have what was asked for drawn, and end the process."""
        if self._painter is not None:
            self._painter.close()
            self._painter = None


class CameraBeside:
    """A Camera whose pictures are drawn by that process, and by this one where that cannot."""

    def __init__(self, camera: SimulatedCamera, beside: Beside, *, awaited: bool = False) -> None:
        """See what `camera` sees; both count their pictures together.

        Of pictures that are awaited there is one at a time, and none is drawn here only because
        others wait: a stop would not be heard meanwhile.
        """
        self._camera = camera
        self._beside = beside
        self._awaited = awaited

    def capture(self) -> Frame:
        """The picture of this moment."""
        return self._beside.draw(self._camera, awaited=self._awaited) or self._camera.capture()
