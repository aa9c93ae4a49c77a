"""Motions of arm and fingers as in MoveIt 2, for clients that plan grasps themselves.

They bring the hand to a pose, joints to positions, and the fingers to a gap.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats, carried_by, heading
from executive.types.geometry import Pose
from sim.body.arm import follow
from sim.body.hardware import ARM, Hardware
from sim.body.skill import CannotError, Skill, Thinker
from sim.goals import NO_MOTION, UNREACHABLE, Grip, MoveHand, MoveJoints
from sim.manipulation.grasps import HandPose
from sim.manipulation.hand import Hand
from sim.manipulation.planning import PlanningWorld
from sim.manipulation.reaching import POSTURES, any_path

SHORT_M, TURNED = 0.2, 0.2
"""If a motion of the hand is this short, and turns no more than this (radians), a straight line is
tried first."""
_IN_HAND = HandPose(np.zeros(3), Rotation.identity())
"""The shapes of a load are already in the hand's frame."""
Plan = Callable[[Floats, Floats], Sequence[Floats]]
"""Plans joint positions to pass, from a base pose (x, y, yaw) and the current joint positions."""


class Motions:
    """Skills that move arm and fingers to given goals."""

    def __init__(
        self, hardware: Hardware, planning: PlanningWorld, hand: Hand, thinker: Thinker
    ) -> None:
        """Use these parts; the planning world is only used in computations of the thinker."""
        self._hardware = hardware
        self._planning = planning
        self._hand = hand
        self._thinker = thinker

    def move_hand(self, goal: MoveHand) -> Skill:
        """Bring the point between the fingers to a pose.

        Raises:
            CannotError: if no path is found, or the arm hits something.
        """
        x, y, yaw = self._hardware.base_pose
        base = Pose((x, y, 0.0), heading(yaw))
        there = carried_by(base, goal.pose)
        target = HandPose(np.array(there.position), Rotation.from_quat(there.orientation))
        yield from self._go(partial(self._way_to, target, goal.straight), goal)

    def move_joints(self, goal: MoveJoints) -> Skill:
        """Bring joints of `ARM` to positions; the others keep theirs.

        Raises:
            CannotError: if no path is found, or the arm hits something.
        """
        yield from self._go(partial(self._way_to_joints, goal.joints), goal)

    def grip(self, goal: Grip) -> Skill:
        """Open the fingers to a gap, or close them until they press on something."""
        if goal.gap >= self._hardware.gap:
            self._hand.open(goal.gap)
        else:
            self._hardware.squeeze(goal.force)
        yield from self._hand.until_still()

    def _go(self, plan: Plan, goal: MoveHand | MoveJoints) -> Skill:
        base, arm = self._hardware.base_pose, self._hardware.arm_positions

        def planned() -> Sequence[Floats]:
            self._planning.carry(goal.load, _IN_HAND if goal.load else None)
            return plan(base, arm)

        path = yield from self._thinker.compute(planned)
        yield from follow(self._hardware, path, goal.speed)

    def _way_to(
        self, target: HandPose, straight: bool, base: Floats, arm: Floats
    ) -> Sequence[Floats]:
        line = (
            self._line(target, base, arm) if straight or self._is_short(target, base, arm) else None
        )
        if line is not None:
            return line
        if straight:
            raise CannotError(NO_MOTION)
        found = False
        for posture in (arm, *(one for some in POSTURES for one in some)):
            end = self._planning.solve(base, target, posture)
            if end is None:
                continue
            found = True
            if path := any_path(self._planning, base, arm, end):
                return path
        raise CannotError(NO_MOTION if found else UNREACHABLE)

    def _is_short(self, target: HandPose, base: Floats, arm: Floats) -> bool:
        hand = self._planning.hand(base, arm)
        turn = (target.rotation * hand.rotation.inv()).magnitude()
        return bool(np.linalg.norm(target.position - hand.position) < SHORT_M and turn < TURNED)

    def _line(self, target: HandPose, base: Floats, arm: Floats) -> Sequence[Floats] | None:
        """A straight motion, checked without a margin; None if it is not free."""
        joints = self._planning.line(base, arm, target)
        if joints and self._planning.is_last_part_free(base, joints):
            return joints[1:]
        return None

    def _way_to_joints(
        self, joints: Mapping[str, float], base: Floats, arm: Floats
    ) -> Sequence[Floats]:
        end = np.array([joints.get(name, now) for name, now in zip(ARM, arm, strict=True)])
        path = any_path(self._planning, base, arm, end)
        if path is None:
            raise CannotError(NO_MOTION)
        return path
