from collections.abc import Iterator

import pytest

from sim.body.hardware import Hardware
from sim.bullet.client import connect
from sim.transforms import FrameTree

pytestmark = pytest.mark.physics


class Posed:
    """A robot alone, whose joints are set."""

    def __init__(self) -> None:
        self.client = connect()
        self.hardware = Hardware(self.client, (0.0, 0.0, 0.0))
        self.frames = FrameTree(self.client, self.hardware, {})
        self.frames.all()

    def moved_by(self, joint: str, position: float) -> list[str]:
        """The frames that are told when a joint has come here."""
        self.client.resetJointState(self.hardware.body, self.hardware._joints[joint], position)
        return [transform.child for transform in self.frames.moved()]


@pytest.fixture
def robot() -> Iterator[Posed]:
    posed = Posed()
    yield posed
    posed.client.disconnect()


@pytest.mark.parametrize(
    ("joint", "link"),
    [
        ("base_x", "base_link"),
        ("base_yaw", "base_link"),
        ("lift", "carriage"),
        ("head_pan", "head"),
    ],
)
def test_of_the_robot_only_the_link_whose_joint_moved_is_told(
    robot: Posed, joint: str, link: str
) -> None:
    assert robot.moved_by(joint, 0.1) == [link]
    assert not robot.moved_by(joint, 0.1)


def test_what_creeps_is_told_as_soon_as_it_has_come_far_enough(robot: Posed) -> None:
    told = []
    for step in range(1, 5):
        robot.moved_by("head_pan", 0.1 * step)
        told.append(robot.moved_by("lift", 0.08 + step * 6e-5))
    assert told == [[], ["carriage"], [], ["carriage"]]


def test_all_frames_are_told_again_when_asked_for(robot: Posed) -> None:
    assert len(robot.frames.all()) == len(robot.frames.all()) == len(robot.hardware.parents)
