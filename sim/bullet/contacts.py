"""Contacts of what the robot turns in its hand, kept right.

Bullet keeps up to four points of a contact, each with its normal as it was in the world when the
point was found. Turn what the fingers hold by half a circle, and an old point's normal has become
the wrong way round: the fingers cannot open any more. So contacts are found anew on the way.
"""

import math
from collections.abc import Collection

from executive.types.geometry import Quaternion
from sim.engine import BulletClient

_TURN = math.radians(10.0)
"""A contact whose thing has turned by more is found anew."""
_MOVABLE_GROUP, _WITH_ALL = 1, -1
"""Bullet's collision group and mask of whatever moves."""


class FreshContacts:
    """Has the contacts between the robot and things found anew whenever these have turned."""

    def __init__(self, client: BulletClient, robot: int, things: Collection[int]) -> None:
        """Watch these bodies of a world."""
        self._client = client
        self._robot = robot
        self._things = things
        self._found: dict[int, Quaternion] = {}
        """How each thing that the robot touches was turned when its contacts were found."""

    def keep(self) -> None:
        """Forget what is no longer right; called once per control period."""
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
        """Bullet forgets a body's contacts when it is put in a group, be it the one it is in."""
        self._client.setCollisionFilterGroupMask(body, -1, _MOVABLE_GROUP, _WITH_ALL)


def _angle(one: Quaternion, other: Quaternion) -> float:
    """The turn between two orientations (radians)."""
    along = abs(sum(a * b for a, b in zip(one, other, strict=True)))
    return 2 * math.acos(min(along, 1.0))
