"""Pictures that are drawn by a process of their own."""

import multiprocessing
import os
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from patience import PATIENCE_S

from executive.app.embodiment import Setup
from executive.app.simulation import physics as physics_of
from executive.config import load_settings
from executive.events import Ended, Inbox
from executive.perception.pipeline import CameraPerception
from executive.records import Note, Picture, Seen
from executive.testing.bench import Notebook, four_rooms, ontology
from executive.types.geometry import Pose
from executive.types.goals import DriveTo
from executive.types.perception import Frame
from executive.types.results import Saw
from sim.bullet.camera import GLANCING, view_from
from sim.faults.injector import FaultInjector
from sim.faults.orders import parse_fault
from sim.objects.objects import load_objects
from sim.pictures import process
from sim.pictures.beside import worthwhile
from sim.pictures.coming import NotDrawnError
from sim.pictures.painter import Asked, Stage
from sim.pictures.scene import Moment
from sim.served.bodies import PhysicsBody
from sim.world import PhysicsWorld

MODELS = load_objects()
ORDERED = [parse_fault(order) for order in ("crate=8.0,6.0@1", "moved=mug:desk@1")]

physics = pytest.mark.physics


class Filmed(PhysicsWorld):
    """A world whose robot drives, with two pictures a second for the log."""

    def __init__(self, faults: Sequence[Any] = ()) -> None:
        self.notes = Notebook()
        self.seconds = 0.0
        injector = FaultInjector(faults, self.notes, lambda: self.seconds) if faults else None
        super().__init__(
            four_rooms(),
            MODELS,
            Inbox(),
            self.notes,
            seed=3,
            camera_hz=2.0,
            injector=injector,
            beside=True,
        )

    def film(self, seconds: float) -> list[Frame]:
        """What the log is given meanwhile."""
        before = len(self.pictures())
        self.robot.start(DriveTo("desk"))
        end = self.seconds + seconds
        while self.seconds < end:
            self.seconds += self.advance(1.0)
        return self.pictures()[before:]

    def pictures(self) -> list[Frame]:
        return [picture.frame for picture in self.notes.all(Picture)]

    def warnings(self) -> list[str]:
        return [note.text for note in self.notes.all(Note) if note.level == "warning"]


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """No process can be started."""

    def refused(*given: object, **named: object) -> None:
        raise OSError("no more processes")

    monkeypatch.setattr(subprocess, "Popen", refused)


def same(one: Frame, other: Frame) -> bool:
    """Whether two frames are the same to the bit."""
    facts = [(frame.number, frame.pose, frame.intrinsics) for frame in (one, other)]
    return (
        facts[0] == facts[1]
        and np.array_equal(one.color, other.color)
        and np.array_equal(one.depth, other.depth)
    )


@physics
def test_pictures_drawn_beside_the_physics_are_the_same_to_the_bit(
    monkeypatch: pytest.MonkeyPatch,
):
    filmed = Filmed(faults=ORDERED)
    beside_it = filmed.film(6.0)
    filmed.close()
    monkeypatch.setattr(process, "MOST_WAITING", 0)
    plain = Filmed(faults=ORDERED)
    at_once = plain.film(6.0)
    plain.close()
    assert len(beside_it) == 12
    assert any(type(frame) is not Frame for frame in beside_it)
    assert all(type(frame) is Frame for frame in at_once)
    assert all(map(same, beside_it, at_once))


@physics
@pytest.mark.parametrize("faults", [[], ORDERED], ids=["none", "ordered"])
def test_what_the_robot_looks_at_is_drawn_beside_and_the_same_to_the_bit(faults: list[Any]):
    world = Filmed(faults=faults)
    world.film(1.0)
    beside_it, at_once = world.eyes.capture(), world.camera.capture()
    assert beside_it.coming
    assert not at_once.coming
    assert at_once.number == beside_it.number + 1
    assert same(beside_it, replace(at_once, number=beside_it.number))
    world.close()


@physics
def test_a_served_robot_looks_with_the_eyes_that_are_drawn_beside():
    world = Filmed()
    body = PhysicsBody(world)
    assert body.draws_beside
    assert body.camera.capture().coming
    world.close()


@physics
def test_a_look_whose_picture_never_comes_is_taken_again_here(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(process, "command", lambda: ["sleep", "0"])
    world = Filmed()
    inbox = Inbox()
    request = CameraPerception(world.eyes, world.detector, inbox, world.notes).see()
    assert inbox.await_computed(30)
    world.close()
    assert [picture.coming for picture in world.pictures()] == [True, False]
    [seen] = world.notes.all(Seen)
    [ended] = inbox.take_all()
    assert isinstance(ended, Ended)
    assert ended.request == request
    assert isinstance(ended.result, Saw)
    assert ended.result.detections is seen.detections
    assert seen.frame_number == 1


@physics
def test_what_was_asked_for_is_drawn_before_the_world_is_closed():
    filmed = Filmed()
    frames = filmed.film(2.0)
    filmed.close()
    assert [frame.color.shape for frame in frames] == [(240, 320, 3)] * 4


@physics
def test_when_the_process_dies_it_is_told_once_and_pictures_are_drawn_here(
    monkeypatch: pytest.MonkeyPatch,
):
    monkeypatch.setattr(process, "command", lambda: ["sleep", "0"])
    filmed = Filmed()
    lost, *_, kept = filmed.film(4.0)
    filmed.close()
    with pytest.raises(NotDrawnError) as raised:
        _ = lost.color
    assert not isinstance(raised.value, OSError)  # that would be the end of a log
    assert kept.color.shape == (240, 320, 3)
    (told,) = filmed.warnings()
    assert "the process that drew them has ended (exit status 0)" in told


@physics
def test_where_no_process_can_be_started_that_is_told_once_and_pictures_are_drawn_here(here: None):
    world = Filmed()
    assert len(world.film(1.0)) == 2
    world.close()
    (told,) = world.warnings()
    assert told.endswith("no process can be started for them: no more processes")


@physics
def test_no_process_is_started_for_spoilt_pictures(here: None):
    world = Filmed([parse_fault("noise=0.1")])
    world.film(1.0)
    assert not PhysicsBody(world).draws_beside
    world.close()
    assert not world.warnings()


@physics
def test_no_process_is_started_for_a_mission_without_pictures_for_the_log(here: None):
    settings = load_settings(camera_hz=0, detector="simulated")
    notes = Notebook()
    body = physics_of(Setup(settings, four_rooms(), Inbox(), notes, ontology(True)))
    body.begin()
    body.close()
    assert not notes.all(Note)


@physics
def test_what_the_robot_looks_at_is_drawn_beside_however_many_pictures_wait(
    monkeypatch: pytest.MonkeyPatch,
):
    monkeypatch.setattr(process, "MOST_WAITING", 0)
    world = Filmed()
    assert all(type(frame) is Frame for frame in world.film(1.0))
    assert world.eyes.capture().coming
    world.close()


@physics
def test_what_the_robot_looks_at_is_the_same_when_one_of_the_two_that_draw_it_is_gone():
    world = Filmed()
    before = world.eyes.capture().color
    (painter,) = children(os.getpid())
    (twin,) = children(painter)
    os.kill(twin, signal.SIGKILL)
    after = world.eyes.capture()
    assert after.coming
    assert np.array_equal(after.color, before)
    assert not world.warnings()
    world.close()


def children(process: int) -> list[int]:
    """The processes that draw, of those that a process has started."""
    tasks = Path(f"/proc/{process}/task").glob("*/children")
    started = [int(id) for task in tasks for id in task.read_text().split()]
    return [id for id in started if b"painter" in Path(f"/proc/{id}/cmdline").read_bytes()]


def test_the_process_ends_when_whoever_asks_is_gone():
    painter = subprocess.Popen(process.command(), stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    painter.communicate(timeout=PATIENCE_S)
    assert painter.returncode == 0


def test_a_process_that_does_not_answer_is_given_up(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(process, "PATIENCE_S", 0.01)
    painter = process.Painter(Stage({}, (), 0), ["sleep", "60"])
    asked = Asked(view_from(Pose(), GLANCING), Moment())
    coming = painter.paint(asked)
    assert coming is not None
    with pytest.raises(NotDrawnError, match="has not answered"):
        coming.result()
    assert painter.paint(asked) is None
    painter.close()


def test_drawing_beside_is_worthwhile_with_cores_of_ones_own_only(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1}, raising=False)
    assert worthwhile()
    monkeypatch.setattr(multiprocessing, "parent_process", object)
    assert not worthwhile()
    monkeypatch.undo()
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0}, raising=False)
    assert not worthwhile()
