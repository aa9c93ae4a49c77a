"""Collision checks for planning, with the furniture of the map and the objects that were seen."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from executive.geometry import Floats
from executive.records import Shape
from executive.types.geometry import Pose
from sim.body.hardware import FOLDED
from sim.bullet.bodies import build_home, create_body
from sim.engine import pybullet as p
from sim.home.home import Home
from sim.manipulation.clutter import CELL_M, Column
from sim.manipulation.grasps import HandPose
from sim.manipulation.kinematics import Kinematics

CHECKED: Floats = np.array([0.015, *[0.05] * 7])
"""Resolution of collision checks along a path in joint space (metres, radians). The hand moves less
than 2 cm between checks: if it keeps 1 cm of distance at each, it touches nothing between them."""
_GRAZE = 0.004
"""At the end of a reach, the held object may be this far inside another one (metres): poses are not
known more exactly."""
_ARM_LINKS = (
    "panda_link2", "panda_link3", "panda_link4", "panda_link5", "panda_link6", "panda_link7",
    "panda_hand", "panda_leftfinger", "panda_rightfinger",
)  # fmt: skip
_OWN_BODY = ("base_link", "carriage", "camera_link")


class PlanningWorld(Kinematics):
    """The arm and base among the furniture of the map, in a separate world for planning."""

    def __init__(self, home: Home) -> None:
        """Build the robot and the furniture; objects on it are not known yet."""
        super().__init__()
        self._furniture = build_home(self._client, home)
        self._target: set[int] = set()
        self._others: set[int] = set()
        self._load: int | None = None
        self._shapes: Sequence[Shape] = ()
        self._in_hand: HandPose | None = None

    def assume_clutter(self, target: Sequence[Column], others: Sequence[Column]) -> None:
        """Replace the obstacles on furniture by these columns.

        Only the last part of a reach may touch those of the target.
        """
        self.forget_target()
        for body in self._others:
            self._client.removeBody(body)
        self._target = {self._column_body(column) for column in target}
        self._others = {self._column_body(column) for column in others}

    def forget_target(self) -> None:
        """Remove the target: it is in the hand now, or no longer where it was."""
        for body in self._target:
            self._client.removeBody(body)
        self._target = set()

    def carry(self, shapes: Sequence[Shape], in_hand: HandPose | None) -> None:
        """Include a held object in collision checks; none if there are no shapes.

        Args:
            shapes: its shapes in its own frame.
            in_hand: the pose of that frame in the hand's frame; None if there are no shapes.
        """
        self._in_hand = in_hand
        if shapes == self._shapes:
            return
        if self._load is not None:
            self._client.removeBody(self._load)
        self._load = create_body(self._client, shapes, Pose()) if shapes else None
        self._shapes = shapes

    def is_last_part_free(self, base: Floats, joints: Sequence[Floats]) -> bool:
        """Whether the arm touches nothing but the target; checked without a safety margin."""
        return not any(self.obstacle(base, arm, 0.0, reaching=True) for arm in joints)

    def obstacle(
        self, base: Floats, arm: Floats, margin: float = 0.01, reaching: bool = False
    ) -> str | None:
        """What the arm or the held object would come too close to; None if nothing.

        Args:
            base: pose (x, y, yaw).
            arm: positions of the joints of `ARM`.
            margin: least distance (metres).
            reaching: whether this is the last part of a reach: the target does not count then, and
                the held object may touch other ones.

        Returns:
            A name in the home, or other words for a message.
        """
        self._assume(base, arm)
        client, body, links = self._client, self._robot.body, self._robot.links
        near = self._near(self._arm_bounds(margin)) - (self._target if reaching else set())
        for other in near:
            if client.getClosestPoints(body, other, margin):
                return self._furniture.get(other, "a thing")
        if self._load is not None:
            self._move_load()
            least = -_GRAZE if reaching else margin
            low, high = client.getAABB(self._load)
            for other in self._near((np.array(low) - margin, np.array(high) + margin)):
                close = client.getClosestPoints(self._load, other, margin)
                if any(contact[8] < least for contact in close):
                    return self._furniture.get(other, "a thing")
            if client.getClosestPoints(self._load, body, 0.0, -1, links["base_link"]):
                return "the robot itself"
        for own in _OWN_BODY:
            for link in _ARM_LINKS[3:]:
                if client.getClosestPoints(body, body, margin, links[link], links[own]):
                    return "the robot itself"
        return None

    def base_obstacle(self, base: Floats, margin: float = 0.02) -> str | None:
        """The furniture that the base at (x, y, yaw) would come closer to than the margin (m)."""
        self._assume(base, FOLDED)
        low, high = self._client.getAABB(self._robot.body, self._robot.links["base_link"])
        reach = np.array([margin, margin, 0.0])
        for other in self._near((np.array(low) - reach, np.array(high) + reach)):
            if other in self._furniture and self._client.getClosestPoints(
                self._robot.body, other, margin, self._robot.links["base_link"]
            ):
                return self._furniture[other]
        return None

    def drive_obstacle(self, path: Sequence[Floats], step: float = 0.05) -> str | None:
        """The furniture that the base would come too close to on a path of poses (x, y, yaw)."""
        for start, end in pairwise(path):
            count = max(1, int(np.ceil(np.linalg.norm((end - start)[:2]) / step)))
            for part in np.linspace(0, 1, count + 1):
                found = self.base_obstacle(start + part * (end - start))
                if found:
                    return found
        return None

    def path_obstacle(self, base: Floats, path: Sequence[Floats]) -> str | None:
        """The first obstacle on a path of joint positions of `ARM`; None if the path is free."""
        for start, end in pairwise(path):
            count = max(1, int(np.ceil((np.abs(end - start) / CHECKED).max())))
            for part in np.linspace(0, 1, count + 1):
                found = self.obstacle(base, start + part * (end - start))
                if found:
                    return found
        return None

    # --- helpers ---

    def _near(self, bounds: tuple[Floats, Floats]) -> set[int]:
        """Ids of bodies that may be within bounds, without the robot and the held object."""
        found = {pair[0] for pair in self._client.getOverlappingObjects(*bounds) or ()}
        return found - {self._robot.body, self._load}

    def _move_load(self) -> None:
        """Move the held object along with the hand."""
        assert self._in_hand is not None
        hand = self._hand()
        self._client.resetBasePositionAndOrientation(
            self._load,
            hand.position + hand.rotation.apply(self._in_hand.position),
            (hand.rotation * self._in_hand.rotation).as_quat(),
        )

    def _column_body(self, column: Column) -> int:
        half = [CELL_M / 2, CELL_M / 2, (column.top - column.foot) / 2]
        shape = self._client.createCollisionShape(p.GEOM_BOX, halfExtents=half)
        middle = (column.x, column.y, (column.foot + column.top) / 2)
        body: int = self._client.createMultiBody(0.0, shape, basePosition=middle)
        return body

    def _arm_bounds(self, margin: float) -> tuple[Floats, Floats]:
        boxes = np.array(
            [self._client.getAABB(self._robot.body, self._robot.links[link]) for link in _ARM_LINKS]
        )
        return boxes[:, 0].min(axis=0) - margin, boxes[:, 1].max(axis=0) + margin
