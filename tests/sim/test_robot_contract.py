"""The robots of both worlds keep the contract, also under faults that do not happen."""

from collections.abc import Iterator

import pytest

from executive.events import Inbox
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.robot import Bench, RobotContract
from sim.fake import FakeRobot, FakeWorld
from sim.faults.fake import FaultyFakeRobot
from sim.faults.injector import FaultInjector
from sim.objects.objects import load_objects


class TestFakeRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Bench:
        inbox = Inbox()
        world = FakeWorld(four_rooms(), inbox, Notebook())
        return Bench(FakeRobot(world), inbox, world.advance, moving=lambda: ("base",) * world.busy)


class TestFaultyFakeRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Bench:
        inbox = Inbox()
        world = FakeWorld(four_rooms(), inbox, notebook := Notebook())
        robot = FaultyFakeRobot(world, FaultInjector([], notebook, lambda: 0.0))
        return Bench(robot, inbox, world.advance, moving=lambda: ("base",) * world.busy)


@pytest.mark.physics
class TestSimulatedRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        from sim.world import PhysicsWorld

        inbox = Inbox()
        world = PhysicsWorld(four_rooms(), load_objects(), inbox, Notebook(), camera_hz=0.0)
        yield Bench(world.robot, inbox, world.advance, moving=world.robot.moving)
        world.close()
