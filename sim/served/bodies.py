"""The two simulated bodies as one who serves them sees them: what a robot knows of itself."""

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

if TYPE_CHECKING:  # it takes long to import, and the instant world does without
    from sim.world import PhysicsWorld

NEAR_M, NEAR_RAD = 0.01, 0.02
"""A pose that is so near to where one stands to use a place, means that place."""
ON_THE_FLOOR_M = 0.02
"""A point that is not higher is on the floor."""
Joints = dict[str, tuple[float, float]]
"""Position and velocity of each (metres, radians; a second)."""


class Body(Protocol):
    """A robot in its world. All of it belongs to one thread."""

    camera: Camera

    @property
    def world(self) -> SimulatedHome:
        """For who checks what came of it: no client hears of it."""
        ...

    @property
    def draws_beside(self) -> bool:
        """Whether the camera's pictures are drawn by another process, so that nobody waits."""
        ...

    @property
    def busy(self) -> bool:
        """Whether it acts; if not, no time passes."""
        ...

    @property
    def moves(self) -> bool:
        """Whether any part of it does."""
        ...

    @property
    def computing(self) -> bool:
        """Whether it waits for something to be computed; no time passes meanwhile."""
        ...

    def advance(self, at_most: float) -> float:
        """Let at most so many seconds pass; return how many."""
        ...

    def start(self, goal: AnyGoal) -> int:
        """Pursue a goal."""
        ...

    def cancel(self, request: int) -> None:
        """Give it up."""
        ...

    def look(self, point: Vector3) -> Goal | Face:
        """The goal of one who wants to look at a point of `map`."""
        ...

    @property
    def pose(self) -> PlanarPose:
        """Of `base_link` in `map` (metres, radians)."""
        ...

    @property
    def velocity(self) -> PlanarPose:
        """Of `base_link`, in its own frame (m/s, rad/s)."""
        ...

    @property
    def holding(self) -> bool:
        """Whether both fingers touch a thing."""
        ...

    @property
    def gap(self) -> float:
        """Between the fingers (metres)."""
        ...

    def joints(self) -> Joints:
        """Those of head, arm and hand."""
        ...

    def frames(self) -> tuple[Transform, ...]:
        """Where its links are, each in the one that carries it, the base in `map`."""
        ...

    def close(self) -> None:
        """Free the world."""
        ...


class PhysicsBody:
    """Implements Body in PyBullet."""

    def __init__(self, world: "PhysicsWorld") -> None:
        """Serve the robot of this world."""
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
        """While a skill is under way; what the robot let go of may settle later."""
        return self._robot.active

    @property
    def moves(self) -> bool:
        """By its encoders."""
        return bool(self._robot.moving())

    @property
    def computing(self) -> bool:
        """While it plans."""
        return self._robot.computing

    def look(self, point: Vector3) -> Goal | Face:
        """Simply that."""
        return Face(point)

    @property
    def pose(self) -> PlanarPose:
        """By its encoders."""
        return self._robot.base_pose

    @property
    def velocity(self) -> PlanarPose:
        """By its encoders."""
        x, y, turn = (float(value) for value in self.world.hardware.base_velocity)
        yaw = self._robot.base_pose[2]
        ahead = x * math.cos(yaw) + y * math.sin(yaw)
        return ahead, y * math.cos(yaw) - x * math.sin(yaw), turn

    @property
    def holding(self) -> bool:
        """By touch."""
        return self._robot.holding

    @property
    def gap(self) -> float:
        """By the encoders of the fingers."""
        return self.world.hardware.gap


class FakeBody:
    """Implements Body in the instant world, where the robot glides from place to place."""

    def __init__(self, world: FakeWorld, robot: FakeRobot, camera: Camera) -> None:
        """Serve this robot."""
        self.world = world
        self._robot = robot
        self.camera = camera
        self.cancel = robot.cancel
        self.advance = world.advance
        self.close = world.close
        self.draws_beside = False

    def start(self, goal: AnyGoal) -> int:
        """Pursue a goal; no head can be turned here but to a place, and there is no arm to move."""
        assert not isinstance(goal, Face | MoveHand | MoveJoints | Grip)
        return self._robot.start(goal)

    @property
    def busy(self) -> bool:
        """While anything is due."""
        return self.world.busy

    @property
    def moves(self) -> bool:
        """While it drives."""
        return self.world.drive is not None

    @property
    def computing(self) -> bool:
        """Never."""
        return False

    def look(self, point: Vector3) -> Goal:
        """At the floor, or at the place where it stands, whatever the point."""
        return LookAt(FLOOR if point[2] < ON_THE_FLOOR_M else self.world.at or FLOOR)

    @property
    def pose(self) -> PlanarPose:
        """Where its drive has led so far."""
        drive = self.world.drive
        return drive.at(self.world.time) if drive else self.world.pose

    @property
    def velocity(self) -> PlanarPose:
        """Nominal."""
        return SPEED_M_S if self.world.drive else 0.0, 0.0, 0.0

    @property
    def holding(self) -> bool:
        """Whether it has a thing."""
        return self._robot.holding

    @property
    def gap(self) -> float:
        """It has no fingers."""
        return 0.0

    def joints(self) -> Joints:
        """It has none that move."""
        return {}

    def frames(self) -> tuple[Transform, ...]:
        """The camera looks down from above the base."""
        x, y, yaw = self.pose
        turn = heading(yaw)
        eye = Pose((0.0, 0.0, EYE_HEIGHT_M), (math.cos(yaw / 2), -math.sin(yaw / 2), 0.0, 0.0))
        return (
            Transform("map", "base_link", Pose((x, y, 0.0), turn)),
            Transform("base_link", "camera_optical", eye),
        )


def drive(home: Home, pose: PlanarPose) -> DriveTo | GoTo:
    """The goal of one who wants to be at a pose: the place that is used from there, if there is."""
    places = (PERSON, home.delivery.name, *(piece.name for piece in home.furniture))
    for place in places:
        x, y, yaw = home.stand(place)
        off = abs(math.remainder(yaw - pose[2], math.tau))
        if math.dist((x, y), pose[:2]) < NEAR_M and off < NEAR_RAD:
            return DriveTo(place)
    return GoTo(*pose)
