"""What is in the hand, as touch and weight tell."""

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from executive.types import Pose
from sim.arm import hold
from sim.client import GRAVITY_M_S2
from sim.grasps import HandPose
from sim.hardware import Floats, Hardware
from sim.objects import ObjectModel
from sim.planning import PlanningWorld
from sim.skill import CONTROL_S, CannotError, Skill

_UNFELT_S = 0.2
"""What the fingers have not felt for longer has fallen."""
_WEIGHING_S = 0.2
_LIGHTEST_KG = 0.03
"""What is lighter, the wrist does not tell from nothing."""
_WEIGHT_FELT = 0.5
"""Share of a thing's weight that the wrist must carry if the thing is in the hand."""

_SWAY, _PUSH_N = 1.5, 8.0
"""While the arm moves, the wrist feels up to so many times the weight; more, by this (newtons), and
the thing has met something."""


class LostError(CannotError):
    """What was in the hand fell out of it on the way, or fell over when it was put down."""


@dataclass(frozen=True, slots=True)
class Held:
    """What is in the hand.

    Attributes:
        model: the thing, as it lay.
        position: of its frame in the hand's frame (metres).
        rotation: of its frame in the hand's frame.
        gap: how far the hand opens for it (metres).
        turn: how it was turned, seen by one who faced the robot that took it (radians).
    """

    model: ObjectModel
    position: Floats
    rotation: Rotation
    gap: float
    turn: float

    @staticmethod
    def taken(model: ObjectModel, pose: Pose, hand: HandPose, gap: float, facing: float) -> "Held":
        """The thing at `pose` in `map`, taken at `hand` by a robot that faced this yaw."""
        to_hand = hand.rotation.inv()
        offset = to_hand.apply(np.asarray(pose.position) - hand.position)
        rotation = Rotation.from_quat(pose.orientation)
        turn = float(rotation.as_euler("ZYX")[0]) - facing + np.pi
        return Held(model, offset, to_hand * rotation, gap, turn)

    def hand_for(self, pose: Pose) -> HandPose:
        """Where the hand must be for the thing to be at `pose` in `map`."""
        rotation = Rotation.from_quat(pose.orientation) * self.rotation.inv()
        return HandPose(np.asarray(pose.position) - rotation.apply(self.position), rotation)


class Hand:
    """Keeps what it should hold apart from what it feels."""

    def __init__(self, hardware: Hardware, planning: PlanningWorld) -> None:
        """Begin with nothing in it."""
        self._hardware = hardware
        self._planning = planning
        self._unfelt_s = 0.0
        self.held: Held | None = None
        """What should be in it, by all that was done."""

    @property
    def holding(self) -> bool:
        """Whether both fingers touch a thing, now."""
        return bool(self._hardware.touched())

    def take(self, held: Held | None) -> None:
        """From now on this should be in the hand; the planner minds it."""
        self.held, self._unfelt_s = held, 0.0
        if held is None:
            self._planning.carry((), None)
        else:
            self._planning.carry(held.model.shapes, HandPose(held.position, held.rotation))

    def feel(self) -> None:
        """Feel whether what should be in the hand is there; called once per control period.

        Raises:
            LostError: if it is not.
        """
        if self.held is None:
            return
        self._unfelt_s = 0.0 if self.holding else self._unfelt_s + CONTROL_S
        if self._unfelt_s > _UNFELT_S:
            name = self.held.model.name
            self.take(None)
            raise LostError(f"the {name} fell from my hand")

    def keep(self, motion: Skill) -> Skill:
        """Move the arm with what is in the hand, and feel it all the while.

        Raises:
            LostError: if it is lost; the arm stops there.
        """
        for _ in motion:
            try:
                self.feel()
            except LostError:
                hold(self._hardware)
                raise
            yield

    def weigh(self) -> Generator[None, None, float]:
        """What the wrist carries (newtons), on average over a moment; with the arm at rest."""
        felt = []
        for _ in range(round(_WEIGHING_S / CONTROL_S)):
            yield
            felt.append(self._hardware.weight)
        return float(np.mean(felt))

    def meets(self, weight: float) -> bool:
        """Whether what is in the hand has met something, if the wrist carried `weight` before."""
        return self._hardware.weight > _SWAY * weight + _PUSH_N

    @staticmethod
    def is_lifted(model: ObjectModel, weight: float) -> bool:
        """Whether so much more in the wrist than before (newtons) may be this thing's weight."""
        if model.mass_kg < _LIGHTEST_KG:
            return True
        return weight > _WEIGHT_FELT * model.mass_kg * GRAVITY_M_S2
