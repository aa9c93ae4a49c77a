"""Puts a served robot together: its world, its faults, its door."""

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
    """What is to be served.

    Attributes:
        home: where the robot is.
        world: `physics`, or `fake` for the instant world.
        arm: `skills`, or, in physics, `moveit`.
        faults: what goes wrong, as `--fault` has it; times are the robot's.
        seed: of the world and of the faults.
        port: to listen on; 0: any that is free.
        speed: how many seconds may pass in a real one.
        gui: whether PyBullet shows its own window.
    """

    home: Home
    world: str = "physics"
    arm: str = SKILLS
    faults: Sequence[str] = ()
    seed: int = 0
    port: int = PORT
    speed: float = FASTEST
    gui: bool = False


class _Teller:
    """A Recorder that tells of the faults that strike, and keeps nothing."""

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell

    def record(self, record: Record) -> None:
        """Tell a mishap."""
        if isinstance(record, Mishap):
            self._tell(f"{record.fault}: {record.text}")


def build(plan: Plan, tell: Callable[[str], None] = lambda text: None) -> Simulation:
    """The robot, ready to be served; `tell` is told each fault that strikes.

    Raises:
        InputError: if a fault is none, or not of this world, or not of a robot.
    """
    faults = parse_faults(plan.faults, plan.home)
    _refuse_the_detectors(faults)
    if plan.world == "fake":
        refuse_physical(faults)
    inbox, recorder = Inbox(), _Teller(tell)
    injector = None
    if faults:
        injector = FaultInjector(faults, recorder, lambda: simulation.now, plan.seed)
        injector.begin()
    make = _fake if plan.world == "fake" else _physics
    body = make(plan, inbox, recorder, injector)
    graph = MOTIONS if plan.arm == MOVEIT else GRAPH
    simulation = Simulation(plan.home, body, graph, inbox, plan.port, plan.speed)
    return simulation


def _fake(plan: Plan, inbox: Inbox, recorder: _Teller, injector: FaultInjector | None) -> Body:
    world = FakeWorld(plan.home, inbox, recorder)
    robot, camera = FakeRobot(world), FakeCamera(world)
    if injector is None:
        return FakeBody(world, robot, camera)
    spoilt: Camera = FaultyCamera(camera, injector)
    return FakeBody(world, FaultyFakeRobot(world, injector), spoilt)


def _physics(plan: Plan, inbox: Inbox, recorder: _Teller, injector: FaultInjector | None) -> Body:
    from sim.pictures.beside import worthwhile  # takes long, and the instant world does without
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


def _refuse_the_detectors(faults: Sequence[Fault]) -> None:
    """What is recognised in pictures is the client's matter."""
    for fault in faults:
        if isinstance(fault, Miss | Confuse):
            what = "a served robot gives pictures, and what is in them is seen by who gets them"
            raise InputError(f"--fault {fault}", what, "leave it out")
