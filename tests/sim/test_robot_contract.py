"""Both worlds keep the robot's contract."""

from collections.abc import Iterator

import pytest

from executive.events import Inbox
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.robot import Bench, RobotContract
from sim.fake import FakeRobot, FakeWorld
from sim.objects.objects import load_objects


class TestFakeRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Bench:
        inbox = Inbox()
        world = FakeWorld(four_rooms(), inbox, Notebook())
        return Bench(FakeRobot(world), inbox, world.advance, moving=lambda: ("base",) * world.busy)


@pytest.mark.physics
class TestSimulatedRobot(RobotContract):
    @pytest.fixture
    def bench(self) -> Iterator[Bench]:
        from sim.world import PhysicsWorld

        inbox = Inbox()
        world = PhysicsWorld(four_rooms(), load_objects(), inbox, Notebook(), camera_hz=0.0)
        yield Bench(world.robot, inbox, world.advance, moving=world.robot.moving)
        world.close()
