"""Faults of the robot's hardware: joints get stuck, fingers slip, and the hand lets go."""

import numpy as np

from executive.geometry import Floats
from sim.body.base import CARRYING, CREEPING
from sim.body.hardware import FINGER_TRAVEL, Hardware
from sim.engine import BulletClient
from sim.faults.injector import FaultInjector
from sim.faults.orders import Drop, Slip, Stuck

GREASY = 0.01
"""Lateral friction coefficient of a finger pad that slips."""
_ON_THE_WAY_M_S = (CREEPING.speed + CARRYING.speed) / 2
"""With an object in the hand, a robot faster than this is transporting it."""


class FaultyHardware(Hardware):
    """Hardware with the faults `Drop`, `Slip` and `Stuck`."""

    def __init__(
        self, client: BulletClient, start: tuple[float, float, float], injector: FaultInjector
    ) -> None:
        """Load the robot at (x, y, yaw) in `map`, with the arm folded."""
        self._injector = injector
        self._stuck_at: dict[Stuck, float] = {}
        super().__init__(client, start)
        self._friction = [client.getDynamicsInfo(self.body, pad)[1] for pad in self._fingers]

    def misbehave(self) -> None:
        """Apply the faults that need no command; called once per control period."""
        self._stick()
        for fault in self._injector.due(Drop):
            if self.touched() and np.hypot(*self.base_velocity[:2]) > _ON_THE_WAY_M_S:
                self._injector.strike(fault, "the hand lets go")
                super().open_fingers(2 * FINGER_TRAVEL)

    def command_arm(self, positions: Floats, velocities: Floats) -> None:
        """Servo the joints; stuck ones stay where they are."""
        positions, velocities = positions.copy(), velocities.copy()
        for fault, position in self._stuck_at.items():
            positions[fault.index], velocities[fault.index] = position, 0.0
        super().command_arm(positions, velocities)

    def squeeze(self, force: float) -> None:
        """Close the fingers, with little friction if they slip."""
        if self._injector.draw(Slip, "the fingers slip"):
            self._use_friction([GREASY] * len(self._fingers))
        super().squeeze(force)

    def open_fingers(self, gap: float) -> None:
        """Move the fingers to a gap (metres), and restore their friction."""
        if hasattr(self, "_friction"):
            self._use_friction(self._friction)
        super().open_fingers(gap)

    def _stick(self) -> None:
        active = self._injector.active(Stuck)
        for fault in active:
            if fault not in self._stuck_at:
                self._stuck_at[fault] = float(self.arm_positions[fault.index])
                self._injector.strike(fault, f"{fault.joint} of the arm is stuck")
        for fault in [old for old in self._stuck_at if old not in active]:
            del self._stuck_at[fault]

    def _use_friction(self, frictions: list[float]) -> None:
        for pad, friction in zip(self._fingers, frictions, strict=True):
            self._client.changeDynamics(self.body, pad, lateralFriction=friction)
