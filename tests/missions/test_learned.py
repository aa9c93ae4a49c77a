"""The weights that come with the project, in the packaged home."""

from collections.abc import Iterator

import numpy as np
import pytest

from executive.events import Inbox
from executive.perception.detector import LEARNED, OnnxDetector
from executive.perception.pipeline import locate
from executive.testing.bench import Notebook
from executive.types.goals import DriveTo, Goal, LookAt
from executive.types.perception import Detection, Frame
from executive.types.results import Succeeded
from sim.home.home_file import load_home
from sim.learning.frames import class_names
from sim.manipulation.registration import fit_pose
from sim.objects.objects import load_objects
from sim.world import PhysicsWorld

pytestmark = pytest.mark.physics

HOME = load_home("four_rooms")
CLOSE_M = 0.012


@pytest.fixture(scope="module")
def detector() -> OnnxDetector:
    return OnnxDetector(LEARNED, lambda name: (name,))


@pytest.fixture(scope="module")
def living() -> Iterator[tuple[PhysicsWorld, Inbox]]:
    inbox = Inbox()
    world = PhysicsWorld(HOME, load_objects(), inbox, Notebook(), seed=4, camera_hz=0)
    yield world, inbox
    world.close()


def do(living: tuple[PhysicsWorld, Inbox], goal: Goal) -> object:
    world, inbox = living
    world.robot.start(goal)
    while not (events := inbox.take_all()):
        world.advance(1.0)
    return getattr(events[0], "result", None)


def test_the_weights_are_small_and_know_every_object(detector: OnnxDetector) -> None:
    assert LEARNED.stat().st_size < 10e6
    assert detector.names == class_names()


@pytest.mark.parametrize("place", ["dining_table", "shelf_lobby", "cabinet_kitchen"])
def test_what_stands_on_furniture_is_recognised_and_located(
    detector: OnnxDetector, living: tuple[PhysicsWorld, Inbox], place: str
) -> None:
    world, _ = living
    assert do(living, DriveTo(place)) == Succeeded()
    assert do(living, LookAt(place)) == Succeeded()
    frame, sure = look(world, detector)
    assert sure.keys() == {name for name, where in HOME.placement.items() if where == place}
    off = []
    for name, seen in sure.items():
        located = locate(seen, frame)
        if located.cut_off:
            assert do(living, LookAt(place, 0, located.position)) == Succeeded()
            straight, again = look(world, detector)
            located = locate(again[name], straight)
        points = np.asarray(located.points, np.float64)
        pose = fit_pose(load_objects()[name], points, np.asarray(frame.pose.position))
        off.append(np.linalg.norm(np.subtract(pose.position, world.truth(name).position)))
    assert max(off) < CLOSE_M


def look(world: PhysicsWorld, detector: OnnxDetector) -> tuple[Frame, dict[str, Detection]]:
    """A picture, and what is surely in it."""
    frame = world.camera.capture()
    return frame, {d.label: d for d in detector.detect(frame) if d.confidence > 0.5}
