"""The detectors of both worlds, and the learned one, keep the contract."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from onnx_models import APPLE, MUG, NAMES, known, v8, write_model
from onnx_models import frame as plain_frame

from executive.events import Inbox
from executive.perception.detector import OnnxDetector
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.detector import DetectorBench, DetectorContract
from executive.testing.contracts.robot import Bench
from executive.types.goals import DriveTo, LookAt
from executive.types.results import Succeeded
from sim.fake import FakeCamera, FakeDetector, FakeRobot, FakeWorld
from sim.faults.injector import FaultInjector, FaultyDetector
from sim.objects.objects import load_objects

OBJECTS = tuple(four_rooms().objects)
PLACE, THERE = "counter_wagon", "sugar_box"


def looking() -> FakeWorld:
    world = FakeWorld(four_rooms(), inbox := Inbox(), Notebook())
    bench = Bench(FakeRobot(world), inbox, world.advance)
    assert bench.do(DriveTo(PLACE)) == bench.do(LookAt(PLACE)) == Succeeded()
    return world


class TestFakeDetector(DetectorContract):
    @pytest.fixture
    def detector_bench(self) -> DetectorBench:
        world = looking()
        frame = FakeCamera(world).capture()
        return DetectorBench(FakeDetector(world), frame, [THERE], OBJECTS)


class TestFaultyDetector(DetectorContract):
    @pytest.fixture
    def detector_bench(self) -> DetectorBench:
        world = looking()
        faults = FaultInjector([], Notebook(), lambda: 0.0)
        detector = FaultyDetector(FakeDetector(world), faults, OBJECTS)
        return DetectorBench(detector, FakeCamera(world).capture(), [THERE], OBJECTS)


class TestOnnxDetector(DetectorContract):
    @pytest.fixture
    def detector_bench(self, tmp_path: Path) -> DetectorBench:
        detector = OnnxDetector(write_model(tmp_path, v8([MUG, APPLE])), known)
        return DetectorBench(detector, plain_frame(), NAMES, NAMES)


@pytest.mark.physics
class TestSimulatedDetector(DetectorContract):
    @pytest.fixture
    def detector_bench(self) -> Iterator[DetectorBench]:
        from sim.world import PhysicsWorld

        world = PhysicsWorld(
            four_rooms(), load_objects(), inbox := Inbox(), Notebook(), camera_hz=0.0
        )
        bench = Bench(world.robot, inbox, world.advance)
        assert bench.do(DriveTo(PLACE)) == bench.do(LookAt(PLACE)) == Succeeded()
        yield DetectorBench(world.detector, world.camera.capture(), [THERE], OBJECTS)
        world.close()
