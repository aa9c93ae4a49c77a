"""The transforms of all frames of the simulated world, and which of them have changed."""

import math
from collections.abc import Iterator, Mapping

from executive.records import Transform
from executive.types.geometry import Pose, Quaternion, Vector3
from sim.body.hardware import Hardware
from sim.bullet.bodies import MAP, frame_pose
from sim.engine import BulletClient

_MOVED = 1e-4
"""Smaller changes are ignored (metres, components of the quaternion)."""
_TURNED = 0.9 * _MOVED
"""Smaller changes of a joint are ignored (metres, radians): the pose of its link changes by no more
than the joint does."""


class FrameTree:
    """The robot's links, each in the frame of its parent, and the objects in `map`."""

    def __init__(self, client: BulletClient, hardware: Hardware, things: Mapping[int, str]) -> None:
        """Follow the robot and the objects `things` (names by body id)."""
        self._client = client
        self._hardware = hardware
        self._things = things
        self._last: dict[str, Pose] = {}
        self._joints = [math.inf] * len(hardware.moved_by)
        """Position of each joint when the pose of its link was last returned."""
        self._bodies: dict[int, tuple[Vector3, Quaternion]] = {}
        """Last pose of each object's body, exactly: most are asleep, and comparing is cheap."""

    def all(self) -> tuple[Transform, ...]:
        """All current transforms."""
        self._last.clear()
        self._joints = [math.inf] * len(self._joints)
        self._bodies.clear()
        return self.moved()

    def moved(self) -> tuple[Transform, ...]:
        """The transforms that have changed since they were last returned."""
        return (*self._moved_links(), *self._moved_things())

    def _moved_links(self) -> Iterator[Transform]:
        hardware, now = self._hardware, self._hardware.all_positions()
        pairs = zip(hardware.moved_by, now, self._joints, strict=True)
        turned = list(dict.fromkeys(link for link, a, b in pairs if abs(a - b) > _TURNED))
        links = {*turned, *(hardware.parents[link] for link in turned)} - {MAP}
        poses = hardware.link_poses(links)
        for link in turned:
            parent = hardware.parents[link]
            pose = poses[link] if parent == MAP else self._seen_from(poses[parent], poses[link])
            if self._differs(link, pose):
                self._joints = [
                    a if moved == link else b
                    for moved, a, b in zip(hardware.moved_by, now, self._joints, strict=True)
                ]
                yield Transform(parent, link, pose)

    def _moved_things(self) -> Iterator[Transform]:
        for body, name in self._things.items():
            there = self._client.getBasePositionAndOrientation(body)
            if there == self._bodies.get(body):
                continue
            self._bodies[body] = there
            if self._differs(name, Pose(*there)):
                yield Transform(MAP, name, frame_pose(self._client, body))

    def _seen_from(self, parent: Pose, pose: Pose) -> Pose:
        back = self._client.invertTransform(parent.position, parent.orientation)
        return Pose(*self._client.multiplyTransforms(*back, pose.position, pose.orientation))

    def _differs(self, name: str, pose: Pose) -> bool:
        """Whether a pose differs from the last one of this name; if so, remember it as the last."""
        last = self._last.get(name)
        if last is not None and _near(pose, last):
            return False
        self._last[name] = pose
        return True


def _near(one: Pose, other: Pose) -> bool:
    """Whether two poses are nearly equal; a quaternion and its negative are the same rotation."""
    if any(abs(a - b) > _MOVED for a, b in zip(one.position, other.position, strict=True)):
        return False
    pairs = list(zip(one.orientation, other.orientation, strict=True))
    return all(abs(a - b) < _MOVED for a, b in pairs) or all(abs(a + b) < _MOVED for a, b in pairs)
