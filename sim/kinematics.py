"""Where the hand is for given joints, which joints bring it somewhere, and what is in the way.

Plans on a second PyBullet world of its own: the robot and the home's furniture as the map knows
them, without any of the things that stand there. Nothing in it moves by itself.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pybullet as p
from pybullet_utils.bullet_client import BulletClient
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from executive.records import Shape
from executive.types import Pose
from sim.bodies import build_home, create_body
from sim.client import connect
from sim.clutter import CELL_M, Column
from sim.grasps import HandPose
from sim.hardware import ARM, BASE, FOLDED, Floats, Hardware
from sim.home import Home

COMFORT: Floats = np.array([0.15, 0.0, 0.1, 0.0, -2.0, 0.0, 2.1, 0.785])
"""The arm bent, hand pointing down before the robot: solutions stay near it where they can."""

POSITION_TOLERANCE = 0.002
ANGLE_TOLERANCE = 0.02
_MILLIMETRE, _HALF_DEGREE = 1e-3, 1e-2
"""Units in which the solver weighs position against orientation."""
_COMFORT_WEIGHT = 0.03
_CHECKED: Floats = np.array([0.03, *[0.1] * 7])
"""How far apart the joints are between checks of a path (metres, radians)."""
_GRAZE = 0.004
"""What is carried may reach this far into something: it is not known any better (metres)."""
_HAND = "panda_grasptarget"
_ARM_LINKS = (
    "panda_link2", "panda_link3", "panda_link4", "panda_link5", "panda_link6", "panda_link7",
    "panda_hand", "panda_leftfinger", "panda_rightfinger",
)  # fmt: skip
_OWN_BODY = ("base_link", "carriage", "camera_link")


class Kinematics:
    """The arm on its base among the furniture of the map."""

    def __init__(self, home: Home) -> None:
        """Build the planning world."""
        self._client: BulletClient = connect()
        self._furniture = build_home(self._client, home)
        self._robot = Hardware(self._client, (0.0, 0.0, 0.0))
        joints = [
            self._client.getJointInfo(self._robot.body, i)
            for i in self._robot.links.values()
            if i >= 0
        ]
        movable = [j for j in joints if j[3] >= 0]
        self._index = {j[1].decode(): j[0] for j in movable}
        self._column = {j[1].decode(): k for k, j in enumerate(sorted(movable, key=lambda j: j[3]))}
        self._arm_columns = [self._column[name] for name in ARM]
        limits = {j[1].decode(): (j[8], j[9]) for j in movable}
        self._lower = np.array([limits[name][0] for name in ARM]) + 0.01
        self._upper = np.array([limits[name][1] for name in ARM]) - 0.01
        self._all = np.zeros(len(movable))
        self._target: set[int] = set()
        self._others: set[int] = set()
        self._load: int | None = None
        self._in_hand: HandPose | None = None

    def assume_clutter(self, target: Sequence[Column], others: Sequence[Column]) -> None:
        """Take these columns, and no others, for things that the arm must not touch.

        Only the last part of a reach may come near the target.
        """
        self.forget_target()
        for body in self._others:
            self._client.removeBody(body)
        self._target = {self._column_body(column) for column in target}
        self._others = {self._column_body(column) for column in others}

    def forget_target(self) -> None:
        """The target is in the hand now, or no longer where it was."""
        for body in self._target:
            self._client.removeBody(body)
        self._target = set()

    def carry(self, shapes: Sequence[Shape], in_hand: HandPose | None) -> None:
        """Take something rigid in the hand into account; nothing if there are no shapes.

        Args:
            shapes: in the thing's frame.
            in_hand: that frame as the hand sees it.
        """
        if self._load is not None:
            self._client.removeBody(self._load)
        self._load = create_body(self._client, shapes, Pose()) if shapes else None
        self._in_hand = in_hand

    @property
    def highest_lift(self) -> float:
        """The upper end of the lift (metres)."""
        return float(self._upper[0])

    def close(self) -> None:
        """Free the planning world."""
        self._client.disconnect()

    def hand(self, base: Floats, arm: Floats) -> HandPose:
        """Where the hand is for a base pose (x, y, yaw) and positions of the joints of `ARM`."""
        self._assume(base, arm)
        return self._hand()

    def solve(self, base: Floats, target: HandPose, near: Floats) -> Floats | None:
        """Joints of `ARM` that bring the hand to the target; None if there are none near `near`."""

        def residual(arm: Floats) -> Floats:
            hand = self.hand(base, arm)
            turn = (hand.rotation * target.rotation.inv()).as_rotvec()
            return np.concatenate(
                (
                    (hand.position - target.position) / _MILLIMETRE,
                    turn / _HALF_DEGREE,
                    _COMFORT_WEIGHT * (arm - COMFORT),
                )
            )

        def jacobian(arm: Floats) -> Floats:
            self._assume(base, arm)
            linear, angular = self._jacobians()
            comfort = _COMFORT_WEIGHT * np.eye(len(ARM))
            return np.vstack((linear / _MILLIMETRE, angular / _HALF_DEGREE, comfort))

        start = np.clip(near, self._lower + 1e-6, self._upper - 1e-6)
        found = least_squares(
            residual, start, jacobian, bounds=(self._lower, self._upper), max_nfev=40
        ).x
        hand = self.hand(base, found)
        off = np.linalg.norm(hand.position - target.position)
        turned = (hand.rotation * target.rotation.inv()).magnitude()
        return found if off < POSITION_TOLERANCE and turned < ANGLE_TOLERANCE else None

    def line(
        self, base: Floats, start: Floats, goal: HandPose, step: float = 0.03
    ) -> list[Floats] | None:
        """Joints that move the hand straight to a pose from where `start` has it; None if none."""
        hand = self.hand(base, start)
        turns = (goal.rotation * hand.rotation.inv()).as_rotvec()
        way = goal.position - hand.position
        count = max(1, int(np.ceil(np.linalg.norm(way) / step)))
        path = [start]
        for part in np.linspace(0, 1, count + 1)[1:]:
            rotation = Rotation.from_rotvec(part * turns) * hand.rotation
            found = self.solve(base, HandPose(hand.position + part * way, rotation), path[-1])
            if found is None or np.abs(found - path[-1])[1:].max() > 0.6:
                return None
            path.append(found)
        return path

    def obstacle(
        self, base: Floats, arm: Floats, margin: float = 0.01, reaching: bool = False
    ) -> str | None:
        """What the arm would come closer to than the margin: a name of the home, or other words.

        While `reaching`, the target of the reach does not count.
        """
        self._assume(base, arm)
        client, body, links = self._client, self._robot.body, self._robot.links
        near = self._near(self._arm_bounds(margin)) - (self._target if reaching else set())
        for other in near:
            if client.getClosestPoints(body, other, margin):
                return self._furniture.get(other, "a thing")
        if self._load is not None:
            self._move_load()
            for other in self._near(client.getAABB(self._load)):
                touching = client.getClosestPoints(self._load, other, 0.0)
                if any(contact[8] < -_GRAZE for contact in touching):
                    return self._furniture.get(other, "a thing")
            if client.getClosestPoints(self._load, body, 0.0, -1, links["base_link"]):
                return "the robot itself"
        for own in _OWN_BODY:
            for link in _ARM_LINKS[3:]:
                if client.getClosestPoints(body, body, margin, links[link], links[own]):
                    return "the robot itself"
        return None

    def base_obstacle(self, base: Floats, margin: float = 0.02) -> str | None:
        """What the base at (x, y, yaw) would come closer to than the margin."""
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
        """What the base would come too close to on its way through poses (x, y, yaw)."""
        for start, end in pairwise(path):
            count = max(1, int(np.ceil(np.linalg.norm((end - start)[:2]) / step)))
            for part in np.linspace(0, 1, count + 1):
                found = self.base_obstacle(start + part * (end - start))
                if found:
                    return found
        return None

    def path_obstacle(self, base: Floats, path: Sequence[Floats]) -> str | None:
        """What would be in the way of moving the joints along the path."""
        for start, end in pairwise(path):
            count = max(1, int(np.ceil((np.abs(end - start) / _CHECKED).max())))
            for part in np.linspace(0, 1, count + 1):
                found = self.obstacle(base, start + part * (end - start))
                if found:
                    return found
        return None

    # --- helpers ---

    def _hand(self) -> HandPose:
        pose = self._robot.link_pose(_HAND)
        return HandPose(np.array(pose.position), Rotation.from_quat(pose.orientation))

    def _near(self, bounds: tuple[Floats, Floats]) -> set[int]:
        """What may be within bounds: anything but the robot and what it carries."""
        found = {pair[0] for pair in self._client.getOverlappingObjects(*bounds) or ()}
        return found - {self._robot.body, self._load}

    def _move_load(self) -> None:
        """Put what is carried where the hand is."""
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

    def _assume(self, base: Floats, arm: Floats) -> None:
        for names, values in ((BASE, base), (ARM, arm)):
            for name, value in zip(names, values, strict=True):
                self._client.resetJointState(self._robot.body, self._index[name], value)
                self._all[self._column[name]] = value

    def _jacobians(self) -> tuple[Floats, Floats]:
        zeros = [0.0] * len(self._all)
        linear, angular = self._client.calculateJacobian(
            self._robot.body,
            self._robot.links[_HAND],
            [0.0, 0.0, 0.0],
            list(self._all),
            zeros,
            zeros,
        )
        return (
            np.array(linear)[:, self._arm_columns],
            np.array(angular)[:, self._arm_columns],
        )

    def _arm_bounds(self, margin: float) -> tuple[Floats, Floats]:
        boxes = np.array(
            [self._client.getAABB(self._robot.body, self._robot.links[link]) for link in _ARM_LINKS]
        )
        return boxes[:, 0].min(axis=0) - margin, boxes[:, 1].max(axis=0) + margin
