"""What is in the hand, as touch and weight tell."""

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats
from executive.types.geometry import Pose
from sim.body.arm import hold
from sim.body.hardware import Hardware
from sim.body.skill import CONTROL_S, CannotError, Skill, pause, wait_until
from sim.bullet.client import GRAVITY_M_S2
from sim.manipulation.grasps import HandPose
from sim.objects.objects import ObjectModel

CLOSING_S = 2.0
"""The fingers take no longer to close, or to come off a thing."""
SETTLING_S = 0.3
"""So long the fingers need to set off, and a thing to come to rest once they are off it."""
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
    """Keeps what it should hold in step with what it feels."""

    def __init__(self, hardware: Hardware) -> None:
        """Begin with nothing in it."""
        self._hardware = hardware
        self._unfelt_s = np.inf
        self._around: Held | None = None
        self._opened = False
        self.held: Held | None = None
        """What should be in it, by all that was done and felt."""

    @property
    def touches(self) -> bool:
        """Whether both fingers touch a thing at this moment."""
        return bool(self._hardware.touched())

    @property
    def holding(self) -> bool:
        """Whether both fingers touch a thing; they may miss it for moments."""
        return self._unfelt_s <= _UNFELT_S or self.touches

    @property
    def grips(self) -> bool:
        """Whether it should hold something, or holds what it was not told of."""
        return self.held is not None or self._unfelt_s <= _UNFELT_S

    @property
    def wavers(self) -> bool:
        """Whether they do miss it for a moment, or have lost it."""
        return self.holding and not self.touches

    def close_on(self, held: Held, force: float) -> None:
        """Press with this force (newtons): what both fingers will feel is this."""
        self._around, self._opened = held, False
        self._hardware.squeeze(force)

    def until_still(self) -> Skill:
        """Wait until the fingers, told to move just now, are still."""
        yield from pause(SETTLING_S)
        yield from wait_until(lambda: self._hardware.fingers_still, CLOSING_S)

    def open(self, gap: float) -> None:
        """Let go; a thing is in the hand as long as it is felt there."""
        self._opened = True
        self._hardware.open_fingers(gap)

    def hold(self) -> None:
        """Stop the fingers where they are; if they touch a thing, they go on pressing or opening.

        So what is gripped stays gripped, and what is let go is let go.
        """
        if not self.holding:
            self._hardware.open_fingers(self._hardware.gap)

    def sense(self) -> None:
        """Feel what is in the hand; called once per control period, whatever the robot does."""
        if self.touches:
            self._unfelt_s = 0.0
            self.held = self.held or self._around
            return
        self._unfelt_s += CONTROL_S
        if self._opened:
            self.held = self._around = None

    def settle(self) -> None:
        """Believe the fingers: what they do not feel is not in the hand."""
        if not self.holding:
            self.held = None

    def feel(self) -> None:
        """Make sure that what should be in the hand is there; called once per control period.

        Raises:
            LostError: if it is not.
        """
        if self.held is not None and not self.holding:
            name, self.held = self.held.model.name, None
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
