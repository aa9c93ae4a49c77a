"""Where every frame of the simulated world is, and which of them moved."""

from collections.abc import Iterator, Mapping

import numpy as np
from pybullet_utils.bullet_client import BulletClient
from scipy.spatial.transform import Rotation

from executive.records import Transform
from executive.types import Pose
from sim.bodies import MAP, frame_pose
from sim.hardware import Hardware

_MOVED = 1e-4
"""Smaller changes (metres, parts of the quaternion) do not count."""


class FrameTree:
    """The robot's links, each in the one that carries it, and the things in `map`."""

    def __init__(self, client: BulletClient, hardware: Hardware, things: Mapping[int, str]) -> None:
        """Follow the robot and the things (names by body id)."""
        self._client = client
        self._hardware = hardware
        self._things = things
        self._last: dict[str, Pose] = {}

    def all(self) -> tuple[Transform, ...]:
        """Every transform, as of now."""
        found = tuple(self._transforms())
        self._last = {transform.child: transform.pose for transform in found}
        return found

    def moved(self) -> tuple[Transform, ...]:
        """The transforms that differ from when they were last returned."""
        found = tuple(
            transform
            for transform in self._transforms()
            if transform.child not in self._last
            or _differ(transform.pose, self._last[transform.child])
        )
        self._last.update({transform.child: transform.pose for transform in found})
        return found

    def _transforms(self) -> Iterator[Transform]:
        poses = self._hardware.link_poses()
        for child, parent in self._hardware.parents.items():
            pose = poses[child]
            yield Transform(
                parent, child, pose if parent == MAP else _seen_from(poses[parent], pose)
            )
        for body, name in self._things.items():
            yield Transform(MAP, name, frame_pose(self._client, body))


def _seen_from(parent: Pose, pose: Pose) -> Pose:
    back = Rotation.from_quat(parent.orientation).inv()
    x, y, z = back.apply(np.subtract(pose.position, parent.position))
    qx, qy, qz, qw = (back * Rotation.from_quat(pose.orientation)).as_quat()
    return Pose((float(x), float(y), float(z)), (float(qx), float(qy), float(qz), float(qw)))


def _differ(one: Pose, other: Pose) -> bool:
    change = np.subtract((*one.position, *one.orientation), (*other.position, *other.orientation))
    return bool(np.abs(change).max() > _MOVED)
