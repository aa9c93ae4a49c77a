"""Builds a served robot: its world, its faults and its server."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from executive.errors import InputError
from executive.events import Inbox
from executive.interfaces.perception import Camera
from executive.records import Mishap, Record
from sim.fake import FakeCamera, FakeRobot, FakeWorld
from sim.faults.fake import FaultyFakeRobot
from sim.faults.injector import FaultInjector, FaultyCamera
from sim.faults.orders import Confuse, Fault, Miss, parse_faults, refuse_physical
from sim.home.home import Home
from sim.served.bodies import Body, FakeBody, PhysicsBody
from sim.served.offered import GRAPH, MOTIONS
from sim.served.ordered import FASTEST, MOVEIT, PORT, SKILLS
from sim.served.simulation import Simulation


@dataclass(frozen=True)
class Plan:
    """The settings of a served robot.

    Attributes:
        home: the robot's home.
        world: `physics`, or `fake` for the instant world.
        arm: `skills`, or, in physics, `moveit`.
        faults: injected faults in the syntax of `--fault`, in simulated time.
        seed: of the world and of the faults.
        port: TCP port to listen on; 0 for any that is free.
        speed: highest ratio of simulated time to real time.
        gui: whether to show PyBullet's window.
    """

    home: Home
    world: str = "physics"
    arm: str = SKILLS
    faults: Sequence[str] = ()
    seed: int = 0
    port: int = PORT
    speed: float = FASTEST
    gui: bool = False


class _FaultReporter:
    """A Recorder that reports the faults that occur, and records nothing."""

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell

    def record(self, record: Record) -> None:
        """Report a mishap; ignore all other records."""
        if isinstance(record, Mishap):
            self._tell(f"{record.fault}: {record.text}")


def build(plan: Plan, tell: Callable[[str], None] = lambda text: None) -> Simulation:
    """Build the robot and its server; `tell` is called with each fault that occurs.

    Raises:
        InputError: if a fault is invalid, not available in this world, or of the detector.
    """
    faults = parse_faults(plan.faults, plan.home)
    _refuse_detector_faults(faults)
    if plan.world == "fake":
        refuse_physical(faults)
    inbox, recorder = Inbox(), _FaultReporter(tell)
    injector = None
    if faults:
        injector = FaultInjector(faults, recorder, lambda: simulation.now, plan.seed)
        injector.begin()
    make = _fake if plan.world == "fake" else _physics
    body = make(plan, inbox, recorder, injector)
    graph = MOTIONS if plan.arm == MOVEIT else GRAPH
    simulation = Simulation(plan.home, body, graph, inbox, plan.port, plan.speed)
    return simulation


def _fake(
    plan: Plan, inbox: Inbox, recorder: _FaultReporter, injector: FaultInjector | None
) -> Body:
    world = FakeWorld(plan.home, inbox, recorder)
    robot, camera = FakeRobot(world), FakeCamera(world)
    if injector is None:
        return FakeBody(world, robot, camera)
    spoilt: Camera = FaultyCamera(camera, injector)
    return FakeBody(world, FaultyFakeRobot(world, injector), spoilt)


def _physics(
    plan: Plan, inbox: Inbox, recorder: _FaultReporter, injector: FaultInjector | None
) -> Body:
    from sim.pictures.beside import worthwhile  # slow to import, and not for the instant world
    from sim.world import PhysicsWorld

    world = PhysicsWorld(
        plan.home,
        plan.home.drawn_models(),
        inbox,
        recorder,
        seed=plan.seed,
        gui=plan.gui,
        camera_hz=0.0,
        injector=injector,
        beside=worthwhile(),
    )
    return PhysicsBody(world)


def _refuse_detector_faults(faults: Sequence[Fault]) -> None:
    """Refuse faults of the detector: it runs in the client.

    Raises:
        InputError: for the first of them.
    """
    for fault in faults:
        if isinstance(fault, Miss | Confuse):
            what = "a served robot gives pictures, and what is in them is seen by who gets them"
            raise InputError(f"--fault {fault}", what, "leave it out")
