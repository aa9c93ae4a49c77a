"""Draws pictures in a second process, which has its own copy of the world, beside the physics.

A world has at most one such process, for the pictures of the log and of the robot's camera. Its
pictures are the same as ours, except for rare pixels in which two surfaces are equally far. The
pixels of a frame arrive later than the frame. Nobody waits for pictures of the log; the mission
waits for those of the robot's camera, but can be stopped meanwhile. If there is no such process, or
too many pictures for the log are queued, this process draws the picture at once.
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
    """Whether a second process has a CPU core to itself; the workers of a pool share theirs."""
    return _cores() > 1 and multiprocessing.parent_process() is None


def _cores() -> int:
    """Number of CPU cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Beside:
    """Draws pictures of one world's cameras in a second process, as long as that works."""

    def __init__(self, actors: Actors, blueprint: Blueprint, recorder: Recorder) -> None:
        """Start the process; if it cannot be started, `draw` returns None.

        Args:
            actors: all that moves in the world.
            blueprint: how the world looks; the world must be complete.
            recorder: receives a warning if the process cannot be started, or fails later.
        """
        self._actors = actors
        self._recorder = recorder
        self._painter: Painter | None = None
        self._unreported = ""
        """Why there is no painter; empty if there is one, or once it is reported."""
        stage = Stage(blueprint.looks, actors.bodies, actors.robot)
        try:
            self._painter = Painter(stage)
        except (OSError, RuntimeError) as error:  # no process, or no thread, is to be had
            self._unreported = f"no process can be started for them: {error}"

    def draw(self, camera: SimulatedCamera, *, awaited: bool) -> Frame | None:
        """Request a picture of the current world; None if this process has to draw it.

        Args:
            camera: which camera.
            awaited: whether the caller will wait for the pixels.
        """
        coming = self._coming(camera, awaited)
        if self._unreported:
            text = printable(f"pictures are not drawn beside the physics: {self._unreported}")
            log.warning("%s", text)
            self._recorder.record(Note("warning", text))
            self._unreported = ""
        return coming

    def _coming(self, camera: SimulatedCamera, awaited: bool) -> Frame | None:
        if self._painter is None:
            return None
        pose, lens = camera.pose(), camera.lens
        pixels = self._painter.paint(Asked(view_from(pose, lens), self._actors.where(), awaited))
        if pixels is not None:
            return ComingFrame(next(camera.numbers), lens, pose, pixels)
        if self._painter.failure:
            self._unreported = self._painter.failure
            self.close()
        return None

    def close(self) -> None:
        """Wait until the requested pictures are drawn, as long as one may take; end the process."""
        if self._painter is not None:
            self._painter.close()
            self._painter = None


class CameraBeside:
    """A Camera whose pictures the second process draws, or this process if that is not possible."""

    def __init__(self, camera: SimulatedCamera, beside: Beside, *, awaited: bool = False) -> None:
        """Take pictures with the pose, lens and numbers of `camera`.

        With `awaited`, the caller waits for each picture before it takes the next. Such a picture
        is queued however long the queue is: while this process draws, it cannot hear a stop.
        """
        self._camera = camera
        self._beside = beside
        self._awaited = awaited

    def capture(self) -> Frame:
        """Take a picture now; its pixels may arrive later (see `ComingFrame`)."""
        return self._beside.draw(self._camera, awaited=self._awaited) or self._camera.capture()
