"""Forward and inverse kinematics of the arm.

They use a second robot in a PyBullet world of its own, in which no physics runs.
"""

from itertools import pairwise

import numpy as np
from scipy.spatial.transform import Rotation

from executive.computing import still_wanted
from executive.geometry import Floats
from sim.body.hardware import ARM, BASE, Hardware
from sim.bullet.client import connect
from sim.engine import BulletClient
from sim.manipulation.grasps import HandPose

POSITION_TOLERANCE = 0.002
ANGLE_TOLERANCE = 0.02
_MILLIMETRE, _HALF_DEGREE = 1e-3, 1e-2
"""Units of errors of position (metres) and orientation (radians): both have the same weight."""
_STAY_WEIGHT = 0.03
"""Weight of the distance to the start posture."""
_DAMPING, _EVALUATIONS, _LEAST_GAIN = 0.1, 40, 0.003
"""The solver's first damping, and its most steps; it also ends when a step reduces the error by
less than the fraction `_LEAST_GAIN`."""
_DIAGONAL = np.diag_indices(len(ARM))
_HAND = "panda_grasptarget"
_LENGTHS = ("panda_link2", "panda_link4", "panda_link6", "panda_link7")
"""Links from shoulder to wrist; the distance between two successive ones is constant."""


class Kinematics:
    """The kinematics of the arm on its base."""

    def __init__(self) -> None:
        """Make a world with nothing but the robot."""
        self._client: BulletClient = connect()
        self._robot = Hardware(self._client, (0.0, 0.0, 0.0))
        joints = [
            self._client.getJointInfo(self._robot.body, i)
            for i in self._robot.links.values()
            if i >= 0
        ]
        movable = [j for j in joints if j[3] >= 0]
        index = {j[1].decode(): j[0] for j in movable}
        column = {j[1].decode(): k for k, j in enumerate(sorted(movable, key=lambda j: j[3]))}
        self._moved = [index[name] for name in (*BASE, *ARM)]
        self._columns = [column[name] for name in (*BASE, *ARM)]
        limits = {j[1].decode(): (j[8], j[9]) for j in movable}
        self._lower = np.array([limits[name][0] for name in ARM]) + 0.01
        self._upper = np.array([limits[name][1] for name in ARM]) - 0.01
        self._all = np.zeros(len(movable))
        joints_at = [self._position(link) for link in _LENGTHS]
        self._length = sum(float(np.linalg.norm(b - a)) for a, b in pairwise(joints_at))
        hand = self._hand()
        self._wrist = hand.rotation.inv().apply(joints_at[-1] - hand.position)
        """The wrist's position (3,) in the frame of the hand."""

    @property
    def limits(self) -> tuple[Floats, Floats]:
        """The lower and upper limits of the joints of `ARM`, less a small margin."""
        return self._lower, self._upper

    def close(self) -> None:
        """Close the world."""
        self._client.disconnect()

    def hand(self, base: Floats, arm: Floats) -> HandPose:
        """The pose of the hand for a base pose (x, y, yaw) and positions of the joints of `ARM`."""
        self._assume(base, arm)
        return self._hand()

    def solve(self, base: Floats, target: HandPose, near: Floats) -> Floats | None:
        """Inverse kinematics: positions of the joints of `ARM` that bring the hand to a pose.

        The method is Levenberg-Marquardt within the joint limits.

        Args:
            base: pose (x, y, yaw).
            target: pose of the hand in `map`.
            near: posture to start from; the solution stays near it.

        Returns:
            The positions, or None if no solution is found.
        """
        near = np.clip(near, self._lower, self._upper)
        self._assume(base, near)
        if self._is_too_far(target, near):
            return None
        joints, damping = near, _DAMPING
        error = self._error(target, joints, near)
        if not error.any():
            return joints
        for _ in range(_EVALUATIONS):
            jacobian = self._jacobian()
            hessian = jacobian.T @ jacobian
            hessian[_DIAGONAL] *= 1 + damping
            low, high = self._lower - joints, self._upper - joints
            moved = joints + _bounded_step(hessian, jacobian.T @ error, low, high)
            self._assume(base, moved)
            new_error = self._error(target, moved, near)
            gain = 1.0 - float(new_error @ new_error) / float(error @ error)
            if gain > 0:
                joints, error, damping = moved, new_error, damping / 3
            else:
                damping *= 10
                self._assume(base, joints)
            if abs(gain) < _LEAST_GAIN:
                break
        off = np.linalg.norm(error[:3]) * _MILLIMETRE
        turned = np.linalg.norm(error[3:6]) * _HALF_DEGREE
        return joints if off < POSITION_TOLERANCE and turned < ANGLE_TOLERANCE else None

    def line(
        self, base: Floats, start: Floats, goal: HandPose, step: float = 0.03
    ) -> list[Floats] | None:
        """Joint positions that move the hand in a straight line to a pose; None if none are found.

        Args:
            base: pose (x, y, yaw).
            start: positions of the joints of `ARM` to start from.
            goal: pose of the hand in `map`.
            step: the longest distance of the hand between two positions (metres).
        """
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

    # --- helpers ---

    def _is_too_far(self, target: HandPose, arm: Floats) -> bool:
        """Whether the arm is too short for the target at any height of the lift.

        `arm` must be the joint positions that are set in the world now.
        """
        shoulder = self._position(_LENGTHS[0])
        wrist = target.position + target.rotation.apply(self._wrist)
        heights = shoulder[2] - arm[0] + np.array([self._lower[0], self._upper[0]])
        shoulder[2] = np.clip(wrist[2], *heights)
        give = POSITION_TOLERANCE + ANGLE_TOLERANCE * np.linalg.norm(self._wrist)
        return bool(np.linalg.norm(wrist - shoulder) > self._length + give)

    def _position(self, link: str) -> Floats:
        return np.array(self._robot.link_pose(link).position)

    def _hand(self) -> HandPose:
        pose = self._robot.link_pose(_HAND)
        return HandPose(np.array(pose.position), Rotation.from_quat(pose.orientation))

    def _assume(self, base: Floats, arm: Floats) -> None:
        still_wanted()
        values = np.concatenate((base, arm))
        self._client.resetJointStatesMultiDof(
            self._robot.body, self._moved, values[:, np.newaxis].tolist()
        )
        self._all[self._columns] = values

    def _error(self, target: HandPose, arm: Floats, near: Floats) -> Floats:
        """The weighted error (14,): of position, of orientation, and distance to the start posture.

        `arm` must be the joint positions that are set in the world now.
        """
        hand = self._hand()
        turn = (hand.rotation * target.rotation.inv()).as_rotvec()
        return np.concatenate(
            (
                (hand.position - target.position) / _MILLIMETRE,
                turn / _HALF_DEGREE,
                _STAY_WEIGHT * (arm - near),
            )
        )

    def _jacobian(self) -> Floats:
        """The Jacobian (14, 8) of the error, at the joint positions set in the world now."""
        zeros = [0.0] * len(self._all)
        linear, angular = self._client.calculateJacobian(
            self._robot.body,
            self._robot.links[_HAND],
            [0.0, 0.0, 0.0],
            list(self._all),
            zeros,
            zeros,
        )
        columns = self._columns[len(BASE) :]
        return np.vstack(
            (
                np.array(linear)[:, columns] / _MILLIMETRE,
                np.array(angular)[:, columns] / _HALF_DEGREE,
                _STAY_WEIGHT * np.eye(len(ARM)),
            )
        )


def _bounded_step(hessian: Floats, gradient: Floats, low: Floats, high: Floats) -> Floats:
    """The approximate minimum of a quadratic form within bounds, by fixing components at them."""
    step, free = np.zeros(len(gradient)), np.ones(len(gradient), dtype=bool)
    while free.any():
        pull = gradient[free] + hessian[np.ix_(free, ~free)] @ step[~free]
        step[free] = -np.linalg.solve(hessian[np.ix_(free, free)], pull)
        outside = free & ((step < low) | (step > high))
        step = np.clip(step, low, high)
        if not outside.any():
            break
        free &= ~outside
    return step
