"""The cameras of both worlds keep the contract, spoilt ones too."""

from collections.abc import Iterator

import pytest

from executive.events import Inbox
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.camera import CameraBench, CameraContract
from sim.fake import FakeCamera, FakeWorld
from sim.faults.injector import FaultInjector, FaultyCamera
from sim.faults.orders import parse_fault
from sim.objects.objects import load_objects

START = four_rooms().robot_start[:2]


class TestFakeCamera(CameraContract):
    @pytest.fixture
    def camera_bench(self) -> CameraBench:
        return CameraBench(FakeCamera(FakeWorld(four_rooms(), Inbox(), Notebook())), START)


class TestNoisyCamera(CameraContract):
    @pytest.fixture
    def camera_bench(self) -> CameraBench:
        camera = FakeCamera(FakeWorld(four_rooms(), Inbox(), Notebook()))
        mishaps = FaultInjector([parse_fault("noise=0.01")], Notebook(), lambda: 0.0)
        return CameraBench(FaultyCamera(camera, mishaps), START)


@pytest.mark.physics
class TestSimulatedCamera(CameraContract):
    @pytest.fixture
    def camera_bench(self) -> Iterator[CameraBench]:
        from sim.world import PhysicsWorld

        world = PhysicsWorld(four_rooms(), load_objects(), Inbox(), Notebook(), camera_hz=0.0)
        yield CameraBench(world.camera, START)
        world.close()
