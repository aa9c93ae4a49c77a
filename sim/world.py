"""The home, its objects and the robot in PyBullet: steps the physics and records what moves."""

from collections.abc import Collection, Mapping

import numpy as np
from scipy.spatial.transform import Rotation

from executive.clock import HANGING_S
from executive.events import Inbox
from executive.interfaces.runtime import Recorder
from executive.records import Picture, Scene, Transform, Transforms
from executive.types.geometry import Pose
from sim.body.description import describe_robot, robot_entities
from sim.body.hardware import Hardware
from sim.body.laser import Laser
from sim.body.skill import CONTROL_S, Thinker
from sim.bullet.bodies import (
    build_home,
    frame_pose,
    home_entities,
    place_objects,
    put_at,
    settle,
)
from sim.bullet.camera import SimulatedDetector
from sim.bullet.client import aim_window, connect
from sim.bullet.contacts import FreshContacts
from sim.cameras import Cameras
from sim.engine import pybullet
from sim.faults.hardware import FaultyHardware
from sim.faults.injector import FaultInjector
from sim.faults.world import WorldFaults
from sim.home.arrangement import NoRoomError, Spot
from sim.home.home import Home
from sim.home.state import spot_on
from sim.manipulation.manipulator import Manipulator
from sim.manipulation.motions import Motions
from sim.manipulation.planning import PlanningWorld
from sim.navigation.durations import durations_in
from sim.navigation.grid import OccupancyGrid
from sim.navigation.navigator import Navigator
from sim.objects.objects import ObjectModel
from sim.pictures.beside import Beside
from sim.pictures.scene import Actors, Blueprint
from sim.robot import SimulatedRobot
from sim.transforms import FrameTree

COARSE_STEPS, FINE_STEPS = 2, 4
"""Physics steps per control period: while driving with an empty hand, and while handling objects.
With fewer fine steps, a held object creeps out of the fingers and falls."""
TRANSFORMS_EVERY = 6
"""Control periods between records of moved frames: ten records a second."""
RESTING_M_S = 0.01
"""An object slower than this is at rest."""
SETTLING_PERIODS = 60
"""After the robot is done, the world runs at most this many control periods more, so that released
objects come to rest."""
_SHIFT_M, _TURN = 0.015, 0.2
"""The largest random displacement of an object from its spot (metres, radians)."""


class PhysicsWorld:
    """Implements SimulatedHome; owns the simulator, the robot and its sensors."""

    def __init__(
        self,
        home: Home,
        models: Mapping[str, ObjectModel],
        inbox: Inbox,
        recorder: Recorder,
        seed: int = 0,
        gui: bool = False,
        camera_hz: float = 1.0,
        injector: FaultInjector | None = None,
        left: Collection[str] = (),
        beside: bool = False,
    ) -> None:
        """Build the home with the robot in it.

        Args:
            home: rooms, furniture, and where objects are.
            models: the models of all objects that may be in the home, by name.
            inbox: receives the results of the robot's goals.
            recorder: receives movements and pictures.
            seed: of the small random displacement of objects; 0 for none.
            gui: whether to show PyBullet's window.
            camera_hz: pictures per second for the log, of simulated time; 0 for none.
            injector: the injected faults, if any.
            left: objects that are exactly where they were left; they are not displaced.
            beside: whether another process draws the pictures of the log and of `eyes`. Ignored if
                faults spoil pictures: the other process does not apply faults.
        """
        self._home = home
        self._models = models
        self._inbox = inbox
        self._recorder = recorder

        self._client = connect(gui)
        self._client.setPhysicsEngineParameter(deterministicOverlappingPairs=1)
        beside = beside and not (injector and injector.spoils_pictures)
        blueprint = Blueprint(self._client) if beside else None
        self._fixtures = build_home(self._client, home)
        if gui:
            aim_window(self._client, home.extent())
        self._things = place_objects(self._client, home, models)
        self._disturb(seed, left)
        self._let_sleep()

        self._planning = PlanningWorld(home)
        self._hardware, self._world_faults = self._with_faults(injector)
        self._contacts = FreshContacts(self._client, self._hardware.body, self._things)
        movable = {**self._things, **(self._world_faults.bodies() if self._world_faults else {})}
        self._frames = FrameTree(self._client, self._hardware, movable)
        self._robots_frames = FrameTree(self._client, self._hardware, {})
        self._beside: Beside | None = None
        if blueprint:
            actors = Actors(self._client, list(movable), self._hardware.body)
            self._beside = Beside(actors, blueprint, recorder)
        self._cameras = Cameras(self._client, self._hardware, injector, self._beside)
        self.camera = self._cameras.looking
        self.eyes = self._cameras.eyes
        """The same camera for users of colour and depth only; another process may draw for it."""
        self.detector = SimulatedDetector(self._cameras.drawn, self._things)
        self.robot = self._robot()

        self._picture_every = round(1 / camera_hz / CONTROL_S) if camera_hz else 0
        self._waits = False
        """Whether the current control period waits for a computation of the robot."""
        self._periods = 0
        """Number of control periods so far."""
        self._last_act = 0
        """The last control period in which the robot was active."""
        self._steps = 0
        """Physics steps per control period that PyBullet is set to; 0 before it is first set."""
        self._owed = 0.0
        """Time that has passed since the last control period ended (s)."""

    # --- SimulatedHome ---

    @property
    def busy(self) -> bool:
        """Whether the robot is active, or an object has not come to rest yet."""
        if self.robot.active:
            return True
        return self._periods - self._last_act < SETTLING_PERIODS and self._unsettled()

    def advance(self, at_most: float) -> float:
        """Advance time by `at_most` seconds or one control period, whichever is less.

        Physics advances in whole control periods. While the robot waits for a computation, no
        time passes: this call waits for the result, or for a stop request.

        Returns:
            The time that has passed (s).
        """
        if self.robot.computing:
            self._inbox.await_computed(HANGING_S)
            if self.robot.computing:
                return 0.0
        passed = min(at_most, CONTROL_S)
        if self._owed + passed > CONTROL_S - 1e-9:
            self._control()
            if self.robot.computing:
                return 0.0
            self._pass_period()
            self._owed -= CONTROL_S
        self._owed += passed
        return passed

    def close(self) -> None:
        """Close the simulator and its processes."""
        if self._beside:
            self._beside.close()
        self.robot.close()
        self._planning.close()
        self._client.disconnect()

    def describe(self) -> None:
        """Record the scene, all transforms, and a first picture of the camera."""
        extra = self._world_faults.entities() if self._world_faults else ()
        robot = robot_entities(describe_robot())
        entities = (*home_entities(self._home, self._models), *extra, *robot)
        self._recorder.record(Scene(entities))
        self._recorder.record(Transforms(self._frames.all()))
        if self._picture_every:
            self._recorder.record(Picture(self._cameras.filming.capture()))

    def resting_place(self, name: str) -> str | None:
        """The furniture that an object rests on, by ground truth; None if it rests on none."""
        body = self._body(name)
        if body is None:
            return None
        touching = {contact[2] for contact in self._client.getContactPoints(bodyA=body)}
        if self._hardware.body in touching:
            return None
        names = [self._fixtures[other] for other in touching if other in self._fixtures]
        pieces = {piece.name for piece in (*self._home.furniture, self._home.delivery)}
        return next((found for found in names if found in pieces), None)

    @property
    def held(self) -> str | None:
        """The object that both fingers touch, by ground truth; None if there is none."""
        touched = self._hardware.touched()
        return next((name for body, name in self._things.items() if body in touched), None)

    @property
    def hardware(self) -> Hardware:
        """The robot's motors, encoders and touch sensors."""
        return self._hardware

    def robots_frames(self) -> tuple[Transform, ...]:
        """The transforms of the robot's own links, without those of objects."""
        return self._robots_frames.all()

    def truth(self, name: str) -> Pose:
        """The pose of an object in `map`, by ground truth: for tests, never for the robot."""
        body = self._body(name)
        assert body is not None
        return frame_pose(self._client, body)

    def left(self) -> dict[str, Spot]:
        """The spots of all objects that are on furniture."""
        spots = {}
        for body, name in self._things.items():
            if (place := self.resting_place(name)) and name != self.held:
                pose = frame_pose(self._client, body)
                yaw = Rotation.from_quat(pose.orientation).as_euler("zyx")[0]
                spots[name] = spot_on(self._home.furniture_named(place), pose.position, yaw)
        return spots

    def put(self, name: str, furniture: str) -> bool:
        """Put an object on other furniture, as a person would; whether that was possible."""
        body = self._body(name)
        if body is None or name == self.held:
            return False
        others = {other: spot for other, spot in self.left().items() if other != name}
        full = self._home.as_left({**others, name: Spot(furniture=furniture)})
        here = {n: spot for n, spot in full.objects.items() if n == name or n in others}
        try:
            pose = full.model_copy(update={"objects": here}).object_pose(name)
        except NoRoomError:
            return False
        put_at(self._client, body, pose)
        for fixture, piece in self._fixtures.items():
            if piece == furniture:
                self._activate(fixture, pybullet.ACTIVATION_STATE_WAKE_UP)
        settle(self._client)
        return True

    # --- physics ---

    def _control(self) -> None:
        """Begin a control period, or continue one in which the robot waited for a computation."""
        if not self._waits:
            if self.robot.active:
                self._last_act = self._periods
            if self._world_faults:
                self._world_faults.act()
            self.robot.feel()
        self.robot.control()
        self._waits = self.robot.computing

    def _pass_period(self) -> None:
        """Simulate one control period, and record what is due."""
        if self.robot.handling:
            self._contacts.keep()
        self._use_steps(FINE_STEPS if self.robot.handling else COARSE_STEPS)
        for _ in range(self._steps):
            self._client.stepSimulation()
        self._periods += 1
        if self._periods % TRANSFORMS_EVERY == 0:
            self._write_moved()
        if self._picture_every and self._periods % self._picture_every == 0:
            self._recorder.record(Picture(self._cameras.filming.capture()))

    def _use_steps(self, steps: int) -> None:
        if steps != self._steps:
            self._steps = steps
            self._client.setPhysicsEngineParameter(fixedTimeStep=CONTROL_S / steps)

    def _write_moved(self) -> None:
        moved = self._frames.moved()
        if moved:
            self._recorder.record(Transforms(moved))

    def _unsettled(self) -> bool:
        velocities = [self._client.getBaseVelocity(body)[0] for body in self._things]
        return bool(np.abs(velocities).max(initial=0.0) > RESTING_M_S)

    def _time(self) -> float:
        """The robot's time (s)."""
        return self._periods * CONTROL_S

    # --- helpers ---

    def _with_faults(self, injector: FaultInjector | None) -> tuple[Hardware, WorldFaults | None]:
        """The robot's hardware, and the faults of the world if there is an injector."""
        start = self._home.robot_start
        if injector is None:
            return Hardware(self._client, start), None
        hardware = FaultyHardware(self._client, start, injector)
        return hardware, WorldFaults(self._client, self._home, self._things, hardware, injector)

    def _robot(self) -> SimulatedRobot:
        """Build the robot from its navigator, manipulator and the rest."""
        home, hardware, thinker = self._home, self._hardware, Thinker(self._inbox)
        laser = Laser(self._client, hardware)
        grid = OccupancyGrid.from_home(home)
        navigator = Navigator(hardware, laser, grid, self._recorder, self._time, thinker)
        scan = self._cameras.scan
        manipulator = Manipulator(hardware, self._planning, home, self._models, scan, thinker)
        motions = Motions(hardware, self._planning, manipulator.hand, thinker)
        durations = durations_in(home, grid)
        return SimulatedRobot(
            hardware, navigator, durations, manipulator, motions, home, self._inbox, thinker
        )

    def _disturb(self, seed: int, left: Collection[str]) -> None:
        """Displace the objects a little at random, once, before the simulation begins."""
        if seed == 0:
            return
        chance = np.random.default_rng(seed)
        for body, name in self._things.items():
            if name in left:
                continue
            origin = np.asarray(frame_pose(self._client, body).position)
            position, orientation = self._client.getBasePositionAndOrientation(body)
            turn = Rotation.from_euler("z", chance.uniform(-_TURN, _TURN))
            shift = np.append(chance.uniform(-_SHIFT_M, _SHIFT_M, 2), 0.0)
            self._client.resetBasePositionAndOrientation(
                body,
                origin + shift + turn.apply(np.asarray(position) - origin),
                (turn * Rotation.from_quat(orientation)).as_quat(),
            )

    def _let_sleep(self) -> None:
        """Let bodies sleep: an object at rest then costs nothing until something touches it.

        Bullet searches for contacts wherever one of two bodies is awake, so fixed bodies have to
        sleep, too. They fall asleep by themselves after two seconds; by then the contacts of what
        stands on them are known.
        """
        for body in (*self._things, *self._fixtures):
            self._activate(body, pybullet.ACTIVATION_STATE_ENABLE_SLEEPING)
        for body in self._things:
            self._activate(body, pybullet.ACTIVATION_STATE_SLEEP)

    def _activate(self, body: int, state: int) -> None:
        self._client.changeDynamics(body, -1, activationState=state)

    def _body(self, name: str) -> int | None:
        return next((body for body, thing in self._things.items() if thing == name), None)
