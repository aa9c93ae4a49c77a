"""The executive's own perception keeps the contract."""

import pytest

from executive.events import Inbox
from executive.perception.pipeline import CameraPerception
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.perception import PerceptionBench, PerceptionContract
from executive.testing.contracts.robot import Bench
from executive.types.goals import DriveTo, LookAt
from executive.types.results import Succeeded
from sim.fake import FakeCamera, FakeDetector, FakeRobot, FakeWorld


class TestCameraPerception(PerceptionContract):
    @pytest.fixture
    def perception_bench(self) -> PerceptionBench:
        inbox, notebook = Inbox(), Notebook()
        world = FakeWorld(four_rooms(), inbox, notebook)
        bench = Bench(FakeRobot(world), inbox, world.advance)
        assert bench.do(DriveTo("counter_wagon")) == Succeeded()
        assert bench.do(LookAt("counter_wagon")) == Succeeded()
        eyes = CameraPerception(FakeCamera(world), FakeDetector(world), inbox, notebook)
        return PerceptionBench(eyes, inbox, ["sugar_box"])
