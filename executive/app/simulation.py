"""The two simulated embodiments: in PyBullet, and in the instant world."""

from collections.abc import Callable

from executive.app.embodiment import Embodiment, Setup
from executive.clock import SimulatedClock
from executive.config import Settings
from executive.interfaces.perception import Camera, Detector
from executive.interfaces.robot import Robot
from executive.interfaces.simulation import SimulatedHome
from executive.perception.pipeline import CameraPerception
from sim.fake import FakeCamera, FakeDetector, FakeRobot, FakeWorld
from sim.faults.fake import FaultyFakeRobot
from sim.faults.injector import FaultInjector, FaultyCamera, FaultyDetector
from sim.faults.orders import Fault, parse_faults, refuse_physical
from sim.home.home import Home
from sim.home.state import with_room


def faults_of(settings: Settings, home: Home) -> tuple[Fault, ...]:
    """The faults to inject into the simulated home.

    Raises:
        InputError: if a fault is unknown, or needs physics and the world has none.
    """
    faults = parse_faults(settings.fault, home)
    if settings.world == "fake":
        refuse_physical(faults)
    return faults


def fake(setup: Setup) -> Embodiment:
    """The instant world, in which things are on furniture and have no positions.

    Raises:
        InputError: if a fault is unknown, or needs physics.
    """
    faults = faults_of(setup.settings, setup.home)
    world = FakeWorld(setup.home, setup.inbox, setup.recorder)
    clock = SimulatedClock(setup.inbox, world)
    injector = _injector(setup, faults, clock.now)
    camera: Camera = FakeCamera(world)
    robot: Robot = FakeRobot(world)
    if injector:
        robot, camera = FaultyFakeRobot(world, injector), FaultyCamera(camera, injector)
    return Embodiment(
        robot,
        _perception(setup, camera, FakeDetector(world), injector),
        clock,
        in_map=False,
        truth=world,
        jumps=True,
        keeps=world,
        begin=_begin(world, injector),
        close=world.close,
    )


def physics(setup: Setup) -> Embodiment:
    """The world in PyBullet.

    Raises:
        InputError: if a fault is unknown, or a file is wrong.
    """
    from sim.objects.ycb import with_scans
    from sim.pictures.beside import worthwhile
    from sim.world import PhysicsWorld  # slow to import; the model loads meanwhile

    settings = setup.settings
    faults = faults_of(settings, setup.home)
    injector = _injector(setup, faults, lambda: clock.now())
    models = setup.home.drawn_models()
    home = with_room(setup.home)
    world = PhysicsWorld(
        home,
        with_scans(models, settings.ycb) if settings.ycb else models,
        setup.inbox,
        setup.recorder,
        seed=settings.seed,
        gui=setup.gui,
        camera_hz=settings.camera_hz,
        injector=injector,
        left=setup.left,
        beside=settings.camera_hz > 0 and worthwhile(),
    )
    clock = SimulatedClock(setup.inbox, world)
    simulated = settings.detector == "simulated"
    detector = world.detector if simulated else setup.detector()
    return Embodiment(
        world.robot,
        _perception(setup, world.camera if simulated else world.eyes, detector, injector),
        clock,
        truth=world,
        keeps=world,
        blind_to=blind_to(setup.home, detector),
        begin=_begin(world, injector),
        close=world.close,
    )


def blind_to(home: Home, detector: Detector) -> tuple[str, ...]:
    """The objects that the home declares and the detector does not know.

    Empty if the detector has no attribute `labels`.
    """
    labels = getattr(detector, "labels", None)
    return () if labels is None else tuple(name for name in home.own if name not in labels)


def _injector(
    setup: Setup, faults: tuple[Fault, ...], now: Callable[[], float]
) -> FaultInjector | None:
    return FaultInjector(faults, setup.recorder, now, setup.settings.seed) if faults else None


def _perception(
    setup: Setup, camera: Camera, detector: Detector, injector: FaultInjector | None
) -> CameraPerception:
    if injector:
        detector = FaultyDetector(detector, injector, tuple(setup.home.objects))
    return CameraPerception(camera, detector, setup.inbox, setup.recorder)


def _begin(world: SimulatedHome, injector: FaultInjector | None) -> Callable[[], None]:
    def begin() -> None:
        if injector:
            injector.begin()
        world.describe()

    return begin
