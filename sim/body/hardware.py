"""The robot's motors, encoders and touch sensors; skills act and measure only through these.

Commands set no position directly: they go to motors with the torque and speed limits of the URDF,
and the physics decides what comes of them.
"""

import tempfile
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np

from executive.geometry import Floats
from executive.types.geometry import Pose
from sim.body.description import write_description
from sim.engine import BulletClient
from sim.engine import pybullet as p

ARM = ("lift", *(f"panda_joint{i}" for i in range(1, 8)))
"""The joints that move the hand: the lift (metres), then the arm's seven (radians)."""
BASE = ("base_x", "base_y", "base_yaw")
_DRIVE_LINKS = ("drive_x", "drive_y")
"""Links that exist only to move the base in the simulator; no part of the robot."""
FINGERS = ("panda_finger_joint1", "panda_finger_joint2")
HEAD = ("head_pan", "head_tilt")

FOLDED: Floats = np.array([0.08, 0.0, -0.5, 0.0, -3.0, 0.0, 2.5, 0.785])
"""Joint positions of `ARM` for driving: arm over the base, hand pointing down, a held object
upright."""

FINGER_FORCE = 70.0
"""Maximum force of each finger (newtons), as on the real hand."""
FINGER_TRAVEL = 0.04
"""How far each finger opens from the centre (metres)."""

STILL = {"base": 5e-3, "arm": 2e-2, "fingers": 2e-3, "head": 2e-2}
"""A part is at rest if all of its joints are slower than this (m/s, rad/s)."""


class Hardware:
    """The robot in a PyBullet world."""

    def __init__(self, client: BulletClient, start: tuple[float, float, float]) -> None:
        """Load the robot at (x, y, yaw) in `map`, with the arm folded."""
        self._client = client
        with tempfile.TemporaryDirectory() as directory:
            path = write_description(Path(directory))
            self.body: int = client.loadURDF(str(path), useFixedBase=True)
        self._joints: dict[str, int] = {}
        self.links: dict[str, int] = {"map": -1}
        self.parents: dict[str, str] = {}
        self.moved_by: list[str] = []
        """The link that each joint moves, by the joint's index in PyBullet."""
        self._force: dict[str, float] = {}
        self._speed: dict[str, float] = {}
        self._read_joints()
        self._arm, self._base, self._fingers, self._head = (
            [self._joints[name] for name in names] for names in (ARM, BASE, FINGERS, HEAD)
        )
        self._couple_fingers()
        self._client.enableJointForceTorqueSensor(self.body, self.links["panda_hand"], True)
        self._reset(start)

    def _read_joints(self) -> None:
        """Index links and joints by name, with the joints' limits and each link's parent."""
        carriers = {-1: "map"}
        for index in range(self._client.getNumJoints(self.body)):
            info = self._client.getJointInfo(self.body, index)
            name, link = info[1].decode(), info[12].decode()
            self._joints[name], self.links[link], carriers[index] = index, index, link
            self._force[name], self._speed[name] = info[10], info[11]
            self.parents[link] = carriers[info[16]]
            self.moved_by.append("base_link" if link in _DRIVE_LINKS else link)
        for inner in _DRIVE_LINKS:
            del self.parents[inner]
        self.parents["base_link"] = "map"

    def _couple_fingers(self) -> None:
        """Make the fingers mirror each other, like the gear in the real hand."""
        gear = self._client.createConstraint(
            self.body,
            self._fingers[0],
            self.body,
            self._fingers[1],
            jointType=p.JOINT_GEAR,
            jointAxis=[1, 0, 0],
            parentFramePosition=[0, 0, 0],
            childFramePosition=[0, 0, 0],
        )
        self._client.changeConstraint(gear, gearRatio=-1, erp=0.1, maxForce=2 * FINGER_FORCE)

    def _reset(self, start: tuple[float, float, float]) -> None:
        """Set the start pose, and hold it."""
        for joints, positions in ((self._base, start), (self._arm, FOLDED)):
            for joint, position in zip(joints, positions, strict=True):
                self._client.resetJointState(self.body, joint, position)
        self.park()
        self.command_arm(FOLDED, np.zeros(len(ARM)))
        self.command_head(0.0, 0.4)
        self.open_fingers(0.0)

    # --- encoders ---

    @property
    def base_pose(self) -> Floats:
        """(x, y, yaw) of `base_link` in `map` (metres, radians); yaw is not wrapped at pi."""
        return self.base_state[0]

    @property
    def base_velocity(self) -> Floats:
        """(m/s, m/s, rad/s) in `map`."""
        return self.base_state[1]

    @property
    def base_state(self) -> tuple[Floats, Floats]:
        """Pose and velocity of the base at the same moment."""
        return self._states(self._base)

    def joint_states(self) -> dict[str, tuple[float, float]]:
        """(position, velocity) of each joint of head, lift, arm, fingers (m, m/s; rad, rad/s)."""
        names = (*HEAD, *ARM, *FINGERS)
        positions, velocities = self._states([self._joints[name] for name in names])
        return dict(
            zip(names, zip(positions.tolist(), velocities.tolist(), strict=True), strict=True)
        )

    @property
    def arm_positions(self) -> Floats:
        """Positions of the joints of `ARM` (metres, radians)."""
        return self._states(self._arm)[0]

    @property
    def arm_speed_limits(self) -> Floats:
        """Speed limits of the joints of `ARM` (m/s, rad/s)."""
        return np.array([self._speed[name] for name in ARM])

    @property
    def fingers_still(self) -> bool:
        """Whether both fingers are at rest."""
        return bool(np.abs(self._states(self._fingers)[1]).max() < STILL["fingers"])

    @property
    def gap(self) -> float:
        """Distance between the finger pads (metres)."""
        return float(self._states(self._fingers)[0].sum())

    def moving(self) -> tuple[str, ...]:
        """Those of base, arm, fingers and head that are not at rest."""
        parts = (self._base, self._arm, self._fingers, self._head)
        return tuple(
            name
            for (name, most), joints in zip(STILL.items(), parts, strict=True)
            if np.abs(self._states(joints)[1]).max() > most
        )

    @property
    def head_positions(self) -> Floats:
        """(pan, tilt) in radians."""
        return self._states(self._head)[0]

    def link_pose(self, link: str) -> Pose:
        """The pose of a link's frame in `map`."""
        state = self._client.getLinkState(self.body, self.links[link], computeForwardKinematics=1)
        return Pose(tuple(state[4]), tuple(state[5]))

    def link_poses(self, links: Collection[str]) -> dict[str, Pose]:
        """The poses of these links' frames in `map`."""
        states = self._client.getLinkStates(
            self.body, [self.links[name] for name in links], computeForwardKinematics=1
        )
        return {n: Pose(tuple(s[4]), tuple(s[5])) for n, s in zip(links, states, strict=True)}

    def all_positions(self) -> list[float]:
        """Positions of all joints, by their indices in PyBullet (metres, radians)."""
        joints = range(len(self.moved_by))
        return [state[0] for state in self._client.getJointStates(self.body, joints)]

    # --- touch ---

    def touched(self) -> set[int]:
        """The ids of the bodies that both fingers touch."""
        contacts = self._client.getContactPoints(bodyA=self.body)
        left, right = ({c[2] for c in contacts if c[3] == finger} for finger in self._fingers)
        return (left & right) - {self.body}

    @property
    def weight(self) -> float:
        """The force on the wrist's sensor: weight of the hand and of what it holds (newtons)."""
        force = self._client.getJointState(self.body, self.links["panda_hand"])[2][:3]
        return float(np.linalg.norm(force))

    # --- motors ---

    def command_base(self, velocity: Floats) -> None:
        """Drive with a velocity (m/s, m/s, rad/s) in `map`."""
        self._command(self._base, BASE, p.VELOCITY_CONTROL, targetVelocities=list(velocity))

    def park(self) -> None:
        """Hold the base where it is."""
        positions = list(self.base_pose)
        self._command(self._base, BASE, p.POSITION_CONTROL, targetPositions=positions)

    def command_arm(self, positions: Floats, velocities: Floats) -> None:
        """Servo the joints of `ARM` to positions, with velocities as feed-forward."""
        self._command(
            self._arm,
            ARM,
            p.POSITION_CONTROL,
            targetPositions=list(positions),
            targetVelocities=list(velocities),
            positionGains=[0.2] * len(ARM),
        )

    def command_head(self, pan: float, tilt: float) -> None:
        """Turn the head to pan (positive: left) and tilt (positive: down), in radians."""
        for joint, name, position in zip(self._head, HEAD, (pan, tilt), strict=True):
            self._client.setJointMotorControl2(
                self.body,
                joint,
                p.POSITION_CONTROL,
                targetPosition=position,
                force=self._force[name],
                maxVelocity=self._speed[name],
            )

    def open_fingers(self, gap: float) -> None:
        """Move the fingers until the pads are `gap` metres apart."""
        for joint in self._fingers:
            self._client.setJointMotorControl2(
                self.body,
                joint,
                p.POSITION_CONTROL,
                targetPosition=gap / 2,
                force=FINGER_FORCE,
                maxVelocity=0.1,
            )

    def squeeze(self, force: float) -> None:
        """Close the fingers until something stops them; each keeps pressing with `force` (N)."""
        for joint in self._fingers:
            self._client.setJointMotorControl2(
                self.body,
                joint,
                p.VELOCITY_CONTROL,
                targetVelocity=-0.05,
                force=min(force, FINGER_FORCE),
            )

    # --- helpers ---

    def _states(self, joints: list[int]) -> tuple[Floats, Floats]:
        states = self._client.getJointStates(self.body, joints)
        return np.array([s[0] for s in states]), np.array([s[1] for s in states])

    def _command(self, joints: list[int], names: tuple[str, ...], mode: int, **how: Any) -> None:
        forces = [self._force[name] for name in names]
        self._client.setJointMotorControlArray(self.body, joints, mode, forces=forces, **how)
