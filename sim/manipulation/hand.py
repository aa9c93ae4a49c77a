"""Keeps track of what is in the hand, from touch and weight."""

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
"""The longest that the fingers take to close, or to come off an object."""
SETTLING_S = 0.3
"""Time for the fingers to start moving, and for a released object to come to rest."""
_UNFELT_S = 0.2
"""An object has fallen if the fingers have not felt it for longer than this."""
_WEIGHING_S = 0.2
"""The weight is averaged over this time."""
_LIGHTEST_KG = 0.03
"""The wrist's sensor cannot detect lighter objects."""
_WEIGHT_FELT = 0.5
"""Least fraction of an object's weight that the wrist must measure if the object is in the hand."""

_SWAY, _PUSH_N = 1.5, 8.0
"""While the arm moves, the wrist measures up to `_SWAY` times the weight. If it measures more, by
`_PUSH_N` (newtons), the object has hit something."""


class LostError(CannotError):
    """The held object fell out of the hand, or fell over when it was put down."""


@dataclass(frozen=True, slots=True)
class Held:
    """A held object.

    Attributes:
        model: its model, in the resting pose that it had.
        position: of its frame in the hand's frame (metres).
        rotation: of its frame in the hand's frame.
        gap: how far the fingers open for it (metres).
        turn: the yaw that it had, in the frame of one who faced the robot (radians).
    """

    model: ObjectModel
    position: Floats
    rotation: Rotation
    gap: float
    turn: float

    @staticmethod
    def taken(model: ObjectModel, pose: Pose, hand: HandPose, gap: float, facing: float) -> "Held":
        """An object at `pose` in `map`, grasped at `hand` by a robot with the yaw `facing`."""
        to_hand = hand.rotation.inv()
        offset = to_hand.apply(np.asarray(pose.position) - hand.position)
        rotation = Rotation.from_quat(pose.orientation)
        turn = float(rotation.as_euler("ZYX")[0]) - facing + np.pi
        return Held(model, offset, to_hand * rotation, gap, turn)

    def hand_for(self, pose: Pose) -> HandPose:
        """The pose of the hand for which the object is at `pose` in `map`."""
        rotation = Rotation.from_quat(pose.orientation) * self.rotation.inv()
        return HandPose(np.asarray(pose.position) - rotation.apply(self.position), rotation)


class Hand:
    """Keeps the object that should be held in step with what the fingers feel."""

    def __init__(self, hardware: Hardware) -> None:
        """Begin with an empty hand."""
        self._hardware = hardware
        self._unfelt_s = np.inf
        self._around: Held | None = None
        self._opened = False
        self.held: Held | None = None
        """The object that should be in the hand, from all actions and touches so far."""

    @property
    def touches(self) -> bool:
        """Whether both fingers touch an object at this moment."""
        return bool(self._hardware.touched())

    @property
    def holding(self) -> bool:
        """Whether both fingers touch an object, or did a moment ago: contacts come and go."""
        return self._unfelt_s <= _UNFELT_S or self.touches

    @property
    def grips(self) -> bool:
        """Whether an object should be held, or the fingers feel an unexpected one."""
        return self.held is not None or self._unfelt_s <= _UNFELT_S

    @property
    def wavers(self) -> bool:
        """Whether the fingers do not touch the object now, but did a moment ago."""
        return self.holding and not self.touches

    def close_on(self, held: Held, force: float) -> None:
        """Close with a force (newtons); what both fingers then feel is `held`."""
        self._around, self._opened = held, False
        self._hardware.squeeze(force)

    def until_still(self) -> Skill:
        """Wait until the fingers, which were commanded just now, are at rest."""
        yield from pause(SETTLING_S)
        yield from wait_until(lambda: self._hardware.fingers_still, CLOSING_S)

    def open(self, gap: float) -> None:
        """Open to a gap (metres); an object counts as held as long as it is felt."""
        self._opened = True
        self._hardware.open_fingers(gap)

    def hold(self) -> None:
        """Stop the fingers, unless they touch an object: then they go on pressing or opening.

        So a gripped object stays gripped, and an object that is being released is released.
        """
        if not self.holding:
            self._hardware.open_fingers(self._hardware.gap)

    def sense(self) -> None:
        """Update from touch; called once per control period, whatever the robot does."""
        if self.touches:
            self._unfelt_s = 0.0
            self.held = self.held or self._around
            return
        self._unfelt_s += CONTROL_S
        if self._opened:
            self.held = self._around = None

    def settle(self) -> None:
        """Set `held` to None if the fingers feel nothing."""
        if not self.holding:
            self.held = None

    def feel(self) -> None:
        """Check that the object that should be held is in the hand; called once per control period.

        Raises:
            LostError: if it is not.
        """
        if self.held is not None and not self.holding:
            name, self.held = self.held.model.name, None
            raise LostError(f"the {name} fell from my hand")

    def keep(self, motion: Skill) -> Skill:
        """Run a motion of the arm, and check the held object in each control period.

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
        """Measure the force on the wrist (newtons), averaged over a moment; the arm must rest."""
        felt = []
        for _ in range(round(_WEIGHING_S / CONTROL_S)):
            yield
            felt.append(self._hardware.weight)
        return float(np.mean(felt))

    def meets(self, weight: float) -> bool:
        """Whether the held object has hit something; `weight` is the wrist's force before (N)."""
        return self._hardware.weight > _SWAY * weight + _PUSH_N

    @staticmethod
    def is_lifted(model: ObjectModel, weight: float) -> bool:
        """Whether an additional force on the wrist (newtons) can be the weight of an object."""
        if model.mass_kg < _LIGHTEST_KG:
            return True
        return weight > _WEIGHT_FELT * model.mass_kg * GRAVITY_M_S2
