"""Keeps contact normals right while the robot turns a held object.

Bullet caches up to four points of a contact. The normal of each stays as it was in the world frame
when the point was found. After the robot has turned a held object by half a circle, an old normal
points the wrong way, and the fingers cannot open any more. So old contacts are dropped on the way,
and Bullet finds them again.
"""

import math
from collections.abc import Collection

from executive.types.geometry import Quaternion
from sim.engine import BulletClient

_TURN = math.radians(10.0)
"""The contacts of an object are dropped when it has turned by more than this (radians)."""
_MOVABLE_GROUP, _WITH_ALL = 1, -1
"""Bullet's collision group and mask of movable bodies."""


class FreshContacts:
    """Drops the contacts between the robot and objects that have turned since they were found."""

    def __init__(self, client: BulletClient, robot: int, things: Collection[int]) -> None:
        """Watch the contacts between a robot and objects, all given by their body ids."""
        self._client = client
        self._robot = robot
        self._things = things
        self._found: dict[int, Quaternion] = {}
        """The orientation of each touched object when its contacts were found."""

    def keep(self) -> None:
        """Drop the contacts of objects that have turned; called once per control period."""
        contacts = self._client.getContactPoints(bodyA=self._robot)
        touched = {contact[2] for contact in contacts}.intersection(self._things)
        turned = {body: self._orientation(body) for body in touched}
        self._found = {body: self._found.get(body, turn) for body, turn in turned.items()}
        for body, turn in turned.items():
            if _angle(self._found[body], turn) > _TURN:
                self._forget(body)
                self._found[body] = turn

    def _orientation(self, body: int) -> Quaternion:
        orientation: Quaternion = self._client.getBasePositionAndOrientation(body)[1]
        return orientation

    def _forget(self, body: int) -> None:
        """Drop a body's contacts: Bullet does so when a collision group is set, even the same."""
        self._client.setCollisionFilterGroupMask(body, -1, _MOVABLE_GROUP, _WITH_ALL)


def _angle(one: Quaternion, other: Quaternion) -> float:
    """The angle between two orientations (radians)."""
    along = abs(sum(a * b for a, b in zip(one, other, strict=True)))
    return 2 * math.acos(min(along, 1.0))
