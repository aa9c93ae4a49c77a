"""The interface of the server to the simulated robots of both worlds."""

import math
from typing import TYPE_CHECKING, Protocol

from executive.geometry import heading
from executive.interfaces.perception import Camera
from executive.interfaces.simulation import SimulatedHome
from executive.records import Transform
from executive.types.geometry import Pose, Vector3
from executive.types.goals import DriveTo, Goal, LookAt
from executive.types.home import FLOOR, PERSON
from sim.fake import EYE_HEIGHT_M, SPEED_M_S, FakeRobot, FakeWorld
from sim.goals import AnyGoal, Face, GoTo, Grip, MoveHand, MoveJoints
from sim.home.furniture import PlanarPose
from sim.home.home import Home

if TYPE_CHECKING:  # slow to import, and not needed for the instant world
    from sim.world import PhysicsWorld

NEAR_M, NEAR_RAD = 0.01, 0.02
"""A goal pose this near to the pose for using a place stands for that place."""
ON_THE_FLOOR_M = 0.02
"""Points below this height are on the floor."""
Joints = dict[str, tuple[float, float]]
"""(position, velocity) of each joint by name (m, m/s; rad, rad/s)."""


class Body(Protocol):
    """A robot in its world. Use it on one thread only."""

    camera: Camera

    @property
    def world(self) -> SimulatedHome:
        """Ground truth, for tests; it is not served to clients."""
        ...

    @property
    def draws_beside(self) -> bool:
        """Whether another process draws the camera's pictures, so that the robot need not wait."""
        ...

    @property
    def busy(self) -> bool:
        """Whether the robot pursues a goal; if not, no time passes."""
        ...

    @property
    def moves(self) -> bool:
        """Whether any part of the robot moves."""
        ...

    @property
    def computing(self) -> bool:
        """Whether the robot waits for a computation; no time passes meanwhile."""
        ...

    def advance(self, at_most: float) -> float:
        """Let at most `at_most` seconds pass; return how many have passed."""
        ...

    def start(self, goal: AnyGoal) -> int:
        """Pursue a goal; return the number of the request."""
        ...

    def cancel(self, request: int) -> None:
        """Cancel the goal of a request."""
        ...

    def look(self, point: Vector3) -> Goal | Face:
        """The goal that looks at a point of `map` (metres)."""
        ...

    @property
    def pose(self) -> PlanarPose:
        """(x, y, yaw) of `base_link` in `map` (metres, radians)."""
        ...

    @property
    def velocity(self) -> PlanarPose:
        """Velocity of `base_link` in its own frame (m/s, m/s, rad/s)."""
        ...

    @property
    def holding(self) -> bool:
        """Whether the hand holds an object."""
        ...

    @property
    def gap(self) -> float:
        """The gap between the fingers (metres)."""
        ...

    def joints(self) -> Joints:
        """The states of the joints of head, lift, arm and hand."""
        ...

    def frames(self) -> tuple[Transform, ...]:
        """The transforms of the links, each in its parent's frame, and of the base in `map`."""
        ...

    def close(self) -> None:
        """Close the world."""
        ...


class PhysicsBody:
    """Implements Body in PyBullet."""

    def __init__(self, world: "PhysicsWorld") -> None:
        """Use the robot of this world."""
        self.world = world
        self._robot = world.robot
        self.camera = world.eyes
        self.advance = world.advance
        self.start = world.robot.start
        self.cancel = world.robot.cancel
        self.frames = world.robots_frames
        self.joints = world.hardware.joint_states
        self.close = world.close
        self.draws_beside = world.eyes is not world.camera

    @property
    def busy(self) -> bool:
        """Whether a skill runs; released objects that still move do not count."""
        return self._robot.active

    @property
    def moves(self) -> bool:
        """Whether the encoders show motion."""
        return bool(self._robot.moving())

    @property
    def computing(self) -> bool:
        """Whether a skill waits for a computation."""
        return self._robot.computing

    def look(self, point: Vector3) -> Goal | Face:
        """A goal for the head; the base does not turn."""
        return Face(point)

    @property
    def pose(self) -> PlanarPose:
        """From the encoders."""
        return self._robot.base_pose

    @property
    def velocity(self) -> PlanarPose:
        """From the encoders."""
        x, y, turn = (float(value) for value in self.world.hardware.base_velocity)
        yaw = self._robot.base_pose[2]
        ahead = x * math.cos(yaw) + y * math.sin(yaw)
        return ahead, y * math.cos(yaw) - x * math.sin(yaw), turn

    @property
    def holding(self) -> bool:
        """From the touch sensors."""
        return self._robot.holding

    @property
    def gap(self) -> float:
        """From the fingers' encoders."""
        return self.world.hardware.gap


class FakeBody:
    """Implements Body in the instant world, where the base drives in straight lines."""

    def __init__(self, world: FakeWorld, robot: FakeRobot, camera: Camera) -> None:
        """Use this robot of the world."""
        self.world = world
        self._robot = robot
        self.camera = camera
        self.cancel = robot.cancel
        self.advance = world.advance
        self.close = world.close
        self.draws_beside = False

    def start(self, goal: AnyGoal) -> int:
        """Pursue a goal; arm and hand have no motions here, and the head only looks at places."""
        assert not isinstance(goal, Face | MoveHand | MoveJoints | Grip)
        return self._robot.start(goal)

    @property
    def busy(self) -> bool:
        """Whether any goal has not ended yet."""
        return self.world.busy

    @property
    def moves(self) -> bool:
        """Whether it drives."""
        return self.world.drive is not None

    @property
    def computing(self) -> bool:
        """Never."""
        return False

    def look(self, point: Vector3) -> Goal:
        """The goal to look at the floor, or else at the place where the robot stands."""
        return LookAt(FLOOR if point[2] < ON_THE_FLOOR_M else self.world.at or FLOOR)

    @property
    def pose(self) -> PlanarPose:
        """The pose, interpolated along the current drive."""
        drive = self.world.drive
        return drive.at(self.world.time) if drive else self.world.pose

    @property
    def velocity(self) -> PlanarPose:
        """The nominal speed while it drives."""
        return SPEED_M_S if self.world.drive else 0.0, 0.0, 0.0

    @property
    def holding(self) -> bool:
        """Whether it holds an object."""
        return self._robot.holding

    @property
    def gap(self) -> float:
        """Zero: it has no fingers."""
        return 0.0

    def joints(self) -> Joints:
        """Empty: it has no joints."""
        return {}

    def frames(self) -> tuple[Transform, ...]:
        """The base, and a camera above it that looks down."""
        x, y, yaw = self.pose
        turn = heading(yaw)
        eye = Pose((0.0, 0.0, EYE_HEIGHT_M), (math.cos(yaw / 2), -math.sin(yaw / 2), 0.0, 0.0))
        return (
            Transform("map", "base_link", Pose((x, y, 0.0), turn)),
            Transform("base_link", "camera_optical", eye),
        )


def drive(home: Home, pose: PlanarPose) -> DriveTo | GoTo:
    """The goal to drive to a pose in `map`, or to the place that is used from there, if any."""
    places = (PERSON, home.delivery.name, *(piece.name for piece in home.furniture))
    for place in places:
        x, y, yaw = home.stand(place)
        off = abs(math.remainder(yaw - pose[2], math.tau))
        if math.dist((x, y), pose[:2]) < NEAR_M and off < NEAR_RAD:
            return DriveTo(place)
    return GoTo(*pose)
