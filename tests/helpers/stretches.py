"""How long the thread that ticks hears no stop, and what it is at meanwhile.

A stretch begins when the thread has looked whether anybody said stop, and ends when it looks again
or goes to sleep, of which a stop wakes it. Its processor time is that of the thread: other programs
on the machine, and other threads of this one, are not in it. Its wall time has all of them in it.
"""

import gc
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Any
from unittest import mock

from executive.app.session import Session
from executive.events import Inbox
from logs.recorder import FanOut
from sim.body.laser import Laser
from sim.bullet.camera import SimulatedCamera
from sim.robot import SimulatedRobot
from sim.world import PhysicsWorld
from trees.tree import MissionTree

PICTURES = "taking a picture"
OPENING = "opening the logs"
"""Before a mission begins: nothing moves yet."""
OTHERWISE = "otherwise"
_PARTS: tuple[tuple[type, str, str], ...] = (
    (Session, "_begin", OPENING),
    (Session, "_carry_out", "building and ending the mission"),
    (MissionTree, "tick", "ticking the tree"),
    (FanOut, "record", "handing to the logs"),
    (SimulatedRobot, "start", "starting a goal"),
    (SimulatedRobot, "control", "the robot's control"),
    (PhysicsWorld, "_pass_period", "physics"),
    (SimulatedCamera, "capture", PICTURES),
    (Laser, "scan", "the laser"),
)


@dataclass(frozen=True, slots=True)
class Stretch:
    """One time in which no stop was heard (seconds), and what took most of it."""

    cause: str
    wall_s: float
    processor_s: float


class Stretches:
    """Watches the thread that runs missions; of each cause the longest stretches are kept."""

    def __init__(self) -> None:
        """Nothing was seen yet."""
        self.by_wall: dict[str, Stretch] = {}
        self.by_processor: dict[str, Stretch] = {}
        self._thread = threading.get_ident()
        self._parts: list[str] = []
        self._began: tuple[float, float] | None = None
        self._changed = 0.0
        self._seconds: dict[str, float] = {}

    def longest(self, *but: str) -> Stretch:
        """By processor time, of all causes but these."""
        some = (stretch for cause, stretch in self.by_processor.items() if cause not in but)
        return max(some, key=lambda stretch: stretch.processor_s)

    @contextmanager
    def watching(self) -> Iterator["Stretches"]:
        """Missions that this thread runs within are watched."""
        self._thread = threading.get_ident()
        with ExitStack() as patches:
            for owner, name, part in _PARTS:
                timed = self._timed(getattr(owner, name), part)
                patches.enter_context(mock.patch.object(owner, name, timed))
            patches.enter_context(mock.patch.object(Session, "run", self._mission(Session.run)))
            for name in ("take_all", "_sleep"):
                heard = self._heard(getattr(Inbox, name))
                patches.enter_context(mock.patch.object(Inbox, name, heard))
            for name in ("has_events", "stop_waits"):
                heard = self._heard(getattr(Inbox, name).fget)
                patches.enter_context(mock.patch.object(Inbox, name, property(heard)))
            gc.callbacks.append(self._collects)
            patches.callback(gc.callbacks.remove, self._collects)
            yield self

    # --- what is put around ---

    def _mission(self, run: Callable[..., Any]) -> Callable[..., Any]:
        def watched(*given: Any, **named: Any) -> Any:
            self._begin()
            try:
                return run(*given, **named)
            finally:
                self._began = None

        return watched

    def _timed(self, function: Callable[..., Any], part: str) -> Callable[..., Any]:
        def timed(*given: Any, **named: Any) -> Any:
            if threading.get_ident() != self._thread:
                return function(*given, **named)
            self._enter(part)
            try:
                return function(*given, **named)
            finally:
                self._leave()

        return timed

    def _heard(self, function: Callable[..., Any]) -> Callable[..., Any]:
        def heard(*given: Any, **named: Any) -> Any:
            if threading.get_ident() != self._thread:
                return function(*given, **named)
            self._end()
            try:
                return function(*given, **named)
            finally:
                self._begin()

        return heard

    def _collects(self, phase: str, _: dict[str, int]) -> None:
        if threading.get_ident() == self._thread:
            if phase == "start":
                self._enter("collecting garbage")
            else:
                self._leave()

    # --- the account ---

    def _begin(self) -> None:
        self._seconds.clear()
        self._changed = time.thread_time()
        self._began = time.perf_counter(), self._changed

    def _end(self) -> None:
        if self._began is None:
            return
        self._account()
        cause = max(self._seconds, key=lambda part: self._seconds[part])
        wall_s = time.perf_counter() - self._began[0]
        stretch = Stretch(cause, wall_s, self._changed - self._began[1])
        if cause not in self.by_wall or self.by_wall[cause].wall_s < wall_s:
            self.by_wall[cause] = stretch
        known = self.by_processor.get(cause)
        if known is None or known.processor_s < stretch.processor_s:
            self.by_processor[cause] = stretch
        self._began = None

    def _account(self) -> None:
        """What has passed since the last change belongs to the innermost part."""
        now = time.thread_time()
        part = self._parts[-1] if self._parts else OTHERWISE
        self._seconds[part] = self._seconds.get(part, 0.0) + now - self._changed
        self._changed = now

    def _enter(self, part: str) -> None:
        self._account()
        self._parts.append(part)

    def _leave(self) -> None:
        self._account()
        self._parts.pop()
