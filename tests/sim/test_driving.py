"""Driving in the physics world, judged by the odometry in the log and by contacts."""

from collections.abc import Iterator
from itertools import pairwise
from math import dist

import numpy as np
import pytest

from executive.clock import SimulatedClock
from executive.events import Inbox
from executive.records import PlannedPath, Shape, Transforms
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.robot import Bench
from executive.types.geometry import Pose
from executive.types.goals import DriveTo
from executive.types.results import Failed, Succeeded
from sim.body.base import BRAKING, CARRYING, FREE
from sim.body.laser import RANGE_M, RAYS, Laser, Scan
from sim.bullet.bodies import create_body
from sim.navigation.costmap import Costmap
from sim.navigation.grid import OccupancyGrid
from sim.objects.objects import load_objects
from sim.world import PhysicsWorld

pytestmark = pytest.mark.physics

HOME = four_rooms()
GRID = OccupancyGrid.from_home(HOME)
RED = (0.8, 0.1, 0.1, 1.0)
Odometry = list[tuple[float, float]]


class Drive(Bench):
    """A world whose clock, notes and contacts are kept."""

    def __init__(self) -> None:
        self.notes, inbox = Notebook(), Inbox()
        self.world = PhysicsWorld(HOME, load_objects(), inbox, self.notes, camera_hz=0.0)
        self.clock = SimulatedClock(inbox, self.world)
        self.touched: set[int] = set()
        super().__init__(self.world.robot, inbox, self.advance_and_feel, "counter_wagon")

    def advance_and_feel(self, at_most: float) -> float:
        passed = self.world.advance(at_most)
        base = self.world._hardware.links["base_link"]
        contacts = self.world._client.getContactPoints(self.world._hardware.body, linkIndexA=base)
        self.touched |= {contact[2] for contact in contacts}
        return passed

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds * 60)):
            self.advance(1 / 60)

    def put(self, size: tuple[float, float, float], x: float, y: float) -> int:
        """Put something up that is not on the map."""
        box = Shape("box", size, RED)
        return create_body(self.world._client, (box,), Pose((x, y, size[2] / 2)))

    @property
    def odometry(self) -> Odometry:
        """Logged positions of `base_link`, ten a second while it moves."""
        return [
            (t.pose.position[0], t.pose.position[1])
            for record in self.notes.all(Transforms)
            for t in record.transforms
            if t.child == "base_link"
        ]

    @property
    def fixtures(self) -> set[int]:
        """Bodies that were touched and are no floor."""
        names = self.world._fixtures
        return {b for b in self.touched if not names.get(b, "thing").startswith("floor")}


@pytest.fixture
def robot() -> Iterator[Drive]:
    drive = Drive()
    yield drive
    drive.world.close()


def speeds(odometry: Odometry) -> list[float]:
    return [dist(one, other) / 0.1 for one, other in pairwise(odometry)]


def test_a_crate_in_the_way_is_seen_and_driven_around(robot: Drive):
    crate = robot.put((0.4, 0.4, 0.5), 2.6, 5.6)
    assert robot.do(DriveTo("counter_wagon")) == Succeeded()
    assert crate not in robot.touched
    assert not robot.fixtures


def test_a_door_that_shuts_while_it_drives_is_driven_around_through_other_rooms(robot: Drive):
    request = robot.robot.start(DriveTo("counter_wagon"))
    robot.wait(0.5)
    robot.put((0.1, 1.1, 2.0), 4.2, 5.6)
    assert robot.end_of(request) == Succeeded()
    assert min(y for _, y in robot.odometry) < 3.6
    assert len(robot.notes.all(PlannedPath)) >= 2
    assert not robot.fixtures


def test_a_place_that_nothing_leads_to_any_more_fails_in_words(robot: Drive):
    robot.put((0.1, 1.1, 2.0), 4.2, 5.6)
    robot.put((1.1, 0.1, 2.0), 1.5, 4.0)
    assert robot.do(DriveTo("counter_wagon")) == Failed("the way to the counter_wagon is blocked")
    assert not robot.fixtures


def test_a_way_that_is_free_again_is_used_again(robot: Drive):
    doors = robot.put((0.1, 1.1, 2.0), 4.2, 5.6), robot.put((1.1, 0.1, 2.0), 1.5, 4.0)
    robot.do(DriveTo("counter_wagon"))
    for door in doors:
        robot.world._client.removeBody(door)
    assert robot.do(DriveTo("person")) == Succeeded()
    assert robot.do(DriveTo("counter_wagon")) == Succeeded()


def test_what_is_too_low_for_the_laser_is_bumped_into_and_driven_around(robot: Drive):
    robot.put((0.3, 0.3, 0.09), 2.6, 5.6)
    assert robot.do(DriveTo("counter_wagon")) == Succeeded()


def test_someone_on_the_spot_where_it_wants_to_stand_is_said(robot: Drive):
    x, y, _ = HOME.stand("counter_wagon")
    robot.put((0.3, 0.3, 1.7), x, y)
    result = robot.do(DriveTo("counter_wagon"))
    assert result == Failed("there is no room to stand at the counter_wagon")


def test_a_cancelled_drive_stops_within_the_braking_distance(robot: Drive):
    request = robot.robot.start(DriveTo("counter_wagon"))
    robot.wait(2.5)
    at, speed = robot.odometry[-1], max(speeds(robot.odometry))
    robot.robot.cancel(request)
    robot.wait(1.0)
    assert speed > 0.6
    unseen = 0.1 * speed  # what it may have driven since it was last logged
    assert dist(robot.odometry[-1], at) < speed**2 / (2 * BRAKING) + unseen


def test_speed_and_acceleration_keep_to_their_limits(robot: Drive):
    robot.do(DriveTo("counter_wagon"))
    driven = speeds(robot.odometry)
    assert 0.9 * FREE.speed < max(driven) < 1.05 * FREE.speed
    rises = [(after - before) / 0.1 for before, after in pairwise(driven)]
    assert max(rises) < 1.5 * FREE.acceleration


def test_with_a_thing_in_the_hand_it_drives_slower(robot: Drive, monkeypatch: pytest.MonkeyPatch):
    hand = robot.world.robot._manipulator.hand
    monkeypatch.setattr(type(hand), "feel", lambda self: None)
    hand.held = object()  # type: ignore[assignment]
    robot.do(DriveTo("counter_wagon"))
    assert max(speeds(robot.odometry)) < 1.05 * CARRYING.speed


def test_the_laser_measures_to_the_nearest_wall(robot: Drive):
    scan = Laser(robot.world._client, robot.world._hardware).scan()
    assert scan.middle == pytest.approx(HOME.robot_start[:2])
    assert len(scan.distances) == RAYS
    left = HOME.robot_start[0] - 4.2 - HOME.wall_thickness / 2
    assert scan.distances[0] == pytest.approx(left, abs=0.01)
    assert np.isinf(scan.distances).any()
    assert GRID.clearance_at(scan.hits()).max() < 0.1


def scan_with(distance: float) -> Scan:
    """A scan from the start that meets one thing, straight ahead of ray 90 (along x)."""
    distances = np.full(RAYS, np.inf)
    distances[RAYS // 2] = distance
    return Scan(np.array(HOME.robot_start[:2]), distances)


def test_what_the_laser_sees_through_is_no_longer_marked():
    costmap = Costmap(GRID)
    costmap.take(scan_with(1.5), 0.0)
    ahead = np.array(HOME.robot_start[:2]) + np.array([[1.5, 0.0]])
    assert costmap.blocks(ahead, ahead[0] - 1.5)
    costmap.take(scan_with(RANGE_M), 1.0)
    assert costmap.is_empty


def test_what_is_behind_something_else_stays_marked_until_it_is_forgotten():
    costmap = Costmap(GRID)
    costmap.take(scan_with(1.5), 0.0)
    costmap.take(scan_with(1.0), 1.0)
    ahead = np.array(HOME.robot_start[:2]) + np.array([[1.5, 0.0]])
    assert costmap.grid().clearance_at(ahead)[0] < 0.05
    costmap.forget(60.5)
    assert costmap.grid().clearance_at(ahead)[0] > 0.3


def test_furniture_of_the_map_is_not_marked():
    costmap = Costmap(GRID)
    x, y, _ = HOME.stand("coffee_table")
    to_edge = 0.62
    distances = np.full(RAYS, np.inf)
    distances[RAYS * 3 // 4] = to_edge
    costmap.take(Scan(np.array([x, y]), distances), 0.0)
    assert costmap.is_empty
