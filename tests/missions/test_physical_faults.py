"""Each fault in the physics world: what it does, and what the robot makes of it."""

from collections.abc import Callable, Iterator
from math import dist
from typing import Any

import numpy as np
import pytest

from executive.clock import SimulatedClock
from executive.events import Inbox
from executive.perception.pipeline import locate
from executive.records import Mishap, PlannedPath, Scene, Transforms
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.robot import Bench
from executive.types.goals import DriveTo, LookAt, Pick, PutDown
from executive.types.perception import Detection
from executive.types.results import Failed, Succeeded
from sim.engine import pybullet
from sim.faults.injector import FaultInjector
from sim.faults.orders import parse_faults
from sim.objects.objects import load_objects
from sim.world import PhysicsWorld

pytestmark = pytest.mark.physics

WAGON = "counter_wagon"


class Haunted(Bench):
    """The robot before a place, in a world with faults."""

    def __init__(self, *texts: str, at: str = WAGON) -> None:
        home = four_rooms().model_copy(update={"robot_start": four_rooms().stand(at)})
        self.notes, inbox = Notebook(), Inbox()
        injector = FaultInjector(
            parse_faults(texts, home), self.notes, lambda: self.clock.now(), seed=1
        )
        self.world = PhysicsWorld(
            home, load_objects(), inbox, self.notes, camera_hz=0.0, injector=injector
        )
        self.clock = SimulatedClock(inbox, self.world)
        super().__init__(self.world.robot, inbox, self.pass_time, at)

    def pass_time(self, at_most: float) -> float:
        """Let one period pass, on the clock that the faults go by."""
        before = self.clock.now()
        self.clock.wait(before + min(at_most, 1 / 60))
        return max(self.clock.now() - before, 1e-9)

    def see(self, name: str) -> Detection:
        assert self.do(LookAt(self.place)) == Succeeded()
        frame = self.world.camera.capture()
        (found,) = (d for d in self.world.detector.detect(frame) if d.label == name)
        return locate(found, frame)

    @property
    def strikes(self) -> list[str]:
        return [mishap.text for mishap in self.notes.all(Mishap)]


@pytest.fixture
def haunt() -> Iterator[Callable[..., Haunted]]:
    made: list[Haunted] = []

    def make(*texts: str, **where: Any) -> Haunted:
        made.append(Haunted(*texts, **where))
        return made[-1]

    yield make
    for haunted in made:
        haunted.world.close()


def test_a_moved_thing_stands_elsewhere_from_its_time_on(haunt: Callable[..., Haunted]):
    robot = haunt("moved=sugar_box:desk@2")
    robot.robot.start(DriveTo("person"))
    while robot.clock.now() < 1.9:
        robot.advance(0.1)
    assert robot.world.resting_place("sugar_box") == WAGON
    while robot.clock.now() < 4.0:
        robot.advance(0.1)
    assert robot.world.resting_place("sugar_box") == "desk"
    assert robot.strikes == ["the sugar_box is taken to desk"]


def test_a_shut_door_is_driven_around_and_is_drawn(haunt: Callable[..., Haunted]):
    robot = haunt("blocked=kitchen-living_room@0.5", at="person")
    robot.world.describe()
    (scene,) = robot.notes.all(Scene)
    assert "blocked_kitchen-living_room" in {entity.name for entity in scene.entities}
    assert robot.do(DriveTo(WAGON)) == Succeeded()
    assert len(robot.notes.all(PlannedPath)) >= 2
    moved = {t.child for record in robot.notes.all(Transforms) for t in record.transforms}
    assert "blocked_kitchen-living_room" in moved


def test_a_door_opens_again(haunt: Callable[..., Haunted]):
    robot = haunt("blocked=kitchen-living_room@0-3", "blocked=kitchen-lobby@0-3", at="person")
    assert robot.do(DriveTo(WAGON)) == Succeeded()


def test_behind_shut_doors_nothing_is_reached(haunt: Callable[..., Haunted]):
    robot = haunt("blocked=kitchen-living_room", "blocked=kitchen-lobby", at="person")
    assert robot.do(DriveTo(WAGON)) == Failed(f"the way to the {WAGON} is blocked")


def test_a_crate_is_driven_around(haunt: Callable[..., Haunted]):
    robot = haunt("crate=2.6,5.6@1", at="person")
    assert robot.do(DriveTo(WAGON)) == Succeeded()
    assert robot.strikes == ["a crate stands at 2.6,5.6"]


def test_greasy_fingers_lift_nothing(haunt: Callable[..., Haunted]):
    robot = haunt("slip=1")
    robot.do(DriveTo(WAGON))
    result = robot.do(Pick(robot.see("sugar_box")))
    assert isinstance(result, Failed)
    assert "the sugar_box" in result.reason
    assert not robot.robot.holding
    assert robot.strikes == ["the fingers slip"]


def test_after_a_slip_the_next_grasp_is_another_approach(
    haunt: Callable[..., Haunted], monkeypatch: pytest.MonkeyPatch
):
    robot = haunt("slip=1@0-15")
    hardware = robot.world._hardware
    hands: list[Any] = []
    squeeze = hardware.squeeze

    def squeeze_and_note(force: float) -> None:
        hands.append(hardware.link_pose("panda_grasptarget"))
        squeeze(force)

    monkeypatch.setattr(hardware, "squeeze", squeeze_and_note)
    results = []
    for _ in range(2):
        robot.do(DriveTo(WAGON))
        results.append(robot.do(Pick(robot.see("sugar_box"))))
    assert isinstance(results[0], Failed)
    assert results[1] == Succeeded()
    assert abs(np.dot(hands[0].orientation, hands[1].orientation)) < 0.99 or (
        dist(hands[0].position, hands[1].position) > 0.02
    )


def test_what_falls_on_the_way_is_noticed_at_once(haunt: Callable[..., Haunted]):
    robot = haunt("drop@5")
    robot.do(DriveTo(WAGON))
    assert robot.do(Pick(robot.see("sugar_box"))) == Succeeded()
    before = robot.clock.now()
    result = robot.do(DriveTo("delivery"))
    assert result == Failed("the sugar_box fell from my hand", lost=True)
    assert robot.clock.now() - before < 6.0
    assert not robot.robot.holding


@pytest.mark.parametrize("name", ["apple", "mustard_bottle"])
def test_what_lies_on_the_floor_is_seen_and_picked_up(haunt: Callable[..., Haunted], name: str):
    robot = haunt("noise=0.0001")
    x, y, _ = four_rooms().stand(WAGON)
    body, client = robot.world._body(name), robot.world._client
    lying = pybullet.getQuaternionFromEuler((np.pi / 2, 0.0, 0.0))
    client.resetBasePositionAndOrientation(body, (x + 0.9, y, 0.05), lying)
    client.changeDynamics(body, -1, activationState=pybullet.ACTIVATION_STATE_WAKE_UP)
    for _ in range(240):
        client.stepSimulation()
    for view in range(robot.robot.views("floor")):
        assert robot.do(LookAt("floor", view)) == Succeeded()
        frame = robot.world.camera.capture()
        found = [d for d in robot.world.detector.detect(frame) if d.label == name]
        if found:
            break
    assert robot.do(Pick(locate(found[0], frame))) == Succeeded()
    assert robot.robot.holding


@pytest.mark.parametrize("joint", ["joint2", "lift"])
def test_a_stuck_joint_ends_the_pick_in_words(haunt: Callable[..., Haunted], joint: str):
    robot = haunt(f"stuck={joint}@1")
    robot.do(DriveTo(WAGON))
    result = robot.do(Pick(robot.see("sugar_box")))
    assert isinstance(result, Failed)
    assert f"{joint} is stuck" in result.reason


def test_a_blind_camera_leaves_nothing_to_grasp_or_put_down_by(haunt: Callable[..., Haunted]):
    robot = haunt("blind")
    frame = robot.world.camera.capture()
    assert not frame.color.any()
    assert len(robot.world._cameras.scan()) == 0


def test_with_some_noise_in_the_depth_it_still_grasps(haunt: Callable[..., Haunted]):
    robot = haunt("noise=0.003")
    robot.do(DriveTo(WAGON))
    assert robot.do(Pick(robot.see("sugar_box"))) == Succeeded()
    assert robot.do(PutDown(WAGON)) == Succeeded()
