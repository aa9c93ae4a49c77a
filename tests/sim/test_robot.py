from collections.abc import Iterator
from math import dist, remainder, tau
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from executive.events import Inbox
from executive.records import Picture, PlannedPath, Scene, Shape, Transforms
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.robot import Bench
from executive.types.geometry import Pose
from executive.types.goals import DriveTo, LookAt
from executive.types.results import Failed, Succeeded
from sim.body.hardware import Hardware
from sim.bullet.bodies import create_body
from sim.bullet.client import connect
from sim.home.floorplan import FARTHEST_M
from sim.objects.objects import load_objects
from sim.world import PhysicsWorld

pytestmark = pytest.mark.physics


class Living(Bench):
    """A bench that remembers its world and its notes."""

    def __init__(self, seed: int = 0, camera_hz: float = 0.0) -> None:
        self.notes = Notebook()
        inbox = Inbox()
        self.world = PhysicsWorld(
            four_rooms(), load_objects(), inbox, self.notes, seed=seed, camera_hz=camera_hz
        )
        super().__init__(self.world.robot, inbox, self.world.advance)

    @property
    def base(self) -> tuple[float, float, float]:
        x, y, yaw = self.world.robot.base_pose
        return x, y, yaw


@pytest.fixture
def living() -> Iterator[Living]:
    living = Living()
    yield living
    living.world.close()


def wait(living: Living, seconds: float) -> None:
    passed = 0.0
    while passed < seconds:
        passed += living.world.advance(seconds - passed)


def test_it_arrives_where_one_stands_to_use_the_furniture(living: Living) -> None:
    assert living.do(DriveTo("sideboard")) == Succeeded()
    goal = four_rooms().stand("sideboard")
    assert dist(living.base[:2], goal[:2]) < 0.02
    assert abs(remainder(living.base[2] - goal[2], tau)) < np.radians(2)


def test_it_keeps_its_speed_limit(living: Living) -> None:
    living.robot.start(DriveTo("sideboard"))
    spots = []
    for _ in range(60):
        spots.append(living.base[:2])
        wait(living, 0.1)
    assert 0.6 < max(map(dist, spots, spots[1:])) / 0.1 < 0.85


def test_a_cancelled_drive_brakes_to_rest_within_a_second(living: Living) -> None:
    request = living.robot.start(DriveTo("sideboard"))
    wait(living, 2.0)
    living.robot.cancel(request)
    wait(living, 1.0)
    there = living.base
    assert not living.world.busy
    wait(living, 0.5)
    assert dist(living.base, there) < 1e-3


def test_a_robot_at_rest_needs_no_computing(living: Living) -> None:
    living.do(DriveTo("coffee_table"))
    assert not living.world.busy


def test_looking_brings_the_place_into_the_middle_of_the_picture(living: Living) -> None:
    living.do(DriveTo("coffee_table"))
    assert living.do(LookAt("coffee_table")) == Succeeded()
    pose = living.world.camera.capture().pose
    target = four_rooms().view_targets("coffee_table")[0]
    seen = Rotation.from_quat(pose.orientation).inv().apply(np.subtract(target, pose.position))
    assert np.abs(seen[:2] / seen[2]).max() < 0.03


def test_there_are_no_more_views_than_it_says(living: Living) -> None:
    living.do(DriveTo("coffee_table"))
    views = living.robot.views("coffee_table")
    assert isinstance(living.do(LookAt("coffee_table", views)), Failed)


def test_the_same_seed_moves_everything_alike() -> None:
    def transforms(seed: int) -> list[Any]:
        living = Living(seed)
        living.world.describe()
        living.do(DriveTo("coffee_table"))
        living.world.close()
        return living.notes.all(Transforms)

    first = transforms(1)
    assert first == transforms(1)
    assert first != transforms(2)


def test_what_moves_is_written_down_ten_times_a_second(living: Living) -> None:
    living.world.describe()
    living.do(DriveTo("coffee_table"))
    (scene,) = living.notes.all(Scene)
    first, *later = living.notes.all(Transforms)
    frames = {t.child for t in first.transforms} | {"map"}
    assert {entity.frame_id for entity in scene.entities} <= frames
    assert {"base_link", "panda_hand", "camera_optical", "mug"} <= frames
    assert 15 < len(later) < 60
    assert {t.child for t in later[9].transforms}.isdisjoint({"mug", "camera_optical"})
    assert living.notes.all(PlannedPath)


def test_pictures_are_taken_for_the_log_only_while_it_moves() -> None:
    living = Living(camera_hz=2.0)
    living.do(DriveTo("coffee_table"))
    assert 5 <= len(living.notes.all(Picture)) <= 9
    living.world.close()


def test_only_what_touches_both_fingers_is_held() -> None:
    client = connect()
    client.setGravity(0, 0, 0)
    hardware = Hardware(client, (0.0, 0.0, 0.0))
    hardware.open_fingers(0.06)
    step(client, 100)
    hand = hardware.link_pose("panda_grasptarget")
    aside = Rotation.from_quat(hand.orientation).apply((0.0, 0.0152, 0.0)) + hand.position
    cube = (Shape("box", (0.03, 0.03, 0.03), (1.0, 0.0, 0.0, 1.0)),)
    body = create_body(client, cube, Pose(tuple(aside.tolist()), hand.orientation), mass=0.05)
    step(client, 1)
    assert client.getContactPoints(bodyA=hardware.body, bodyB=body)
    assert not hardware.touched()
    hardware.squeeze(10.0)
    step(client, 200)
    assert hardware.touched() == {body}
    hardware.open_fingers(0.06)
    step(client, 100)
    assert not hardware.touched()
    client.disconnect()


@pytest.mark.parametrize("far", [-FARTHEST_M, FARTHEST_M])
def test_the_base_stands_and_drives_as_far_out_as_a_home_may_be(far: float) -> None:
    client = connect()
    hardware = Hardware(client, (far, far, 0.0))
    step(client, 100)
    assert hardware.base_pose == pytest.approx((far, far, 0.0), abs=1e-3)
    hardware.command_base(np.array([0.3, 0.3, 0.0]))
    step(client, 100)
    assert hardware.base_velocity == pytest.approx((0.3, 0.3, 0.0), abs=1e-2)
    client.disconnect()


def step(client: Any, steps: int) -> None:
    for _ in range(steps):
        client.stepSimulation()
