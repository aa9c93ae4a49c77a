"""Records how a world is built, so that another process can build one that looks the same.

Of this project it imports only the engine, so that the process that only draws starts fast.
"""

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sim.engine import BulletClient
from sim.engine import pybullet as p

Step = tuple[str, tuple[Any, ...], dict[str, Any]]
"""A call of a PyBullet function: its name, and its arguments without the ids of shapes or bodies,
which come from the step before."""
Looks = Mapping[int, Sequence[Step]]
"""The calls that build each body of a world, by body id, in the order of building."""
Placed = tuple[tuple[float, ...], tuple[float, ...]]
"""Position and orientation of a body."""

_NO_SHAPE = -1
_STATIC_MASS = 0.0
"""The mass of bodies that the physics does not move."""
_VISUAL_ONLY = p.URDF_IGNORE_COLLISION_SHAPES


class Blueprint:
    """Records the calls that build the visible parts of a world.

    It replaces functions of the client by ones that also record their arguments.
    """

    def __init__(self, client: BulletClient) -> None:
        """Record from now on; the world of `client` must be empty."""
        self.looks: dict[int, list[Step]] = {}
        self._shapes: dict[int, Step] = {}
        for name in ("createVisualShape", "createVisualShapeArray"):
            self._watch_shapes(client, name)
        self._watch_bodies(client)
        self._watch_files(client)
        self._watch_changes(client)

    def _watch_shapes(self, client: BulletClient, name: str) -> None:
        do = getattr(client, name)

        def watched(*given: Any, **named: Any) -> int:
            made: int = do(*given, **named)
            self._shapes[made] = (name, given, named)
            return made

        setattr(client, name, watched)

    def _watch_bodies(self, client: BulletClient) -> None:
        do = client.createMultiBody

        def watched(mass: float, touched: int, seen: int, *given: Any, **named: Any) -> int:
            made: int = do(mass, touched, seen, *given, **named)
            self.looks[made] = [self._shapes[seen], ("createMultiBody", given, named)]
            return made

        client.createMultiBody = watched

    def _watch_files(self, client: BulletClient) -> None:
        do = client.loadURDF

        def watched(path: str, **named: Any) -> int:
            made: int = do(path, **named)
            self.looks[made] = [("loadURDF", (Path(path).read_text(),), named)]
            return made

        client.loadURDF = watched

    def _watch_changes(self, client: BulletClient) -> None:
        do = client.changeVisualShape

        def watched(body: int, *given: Any, **named: Any) -> None:
            do(body, *given, **named)
            self.looks[body].append(("changeVisualShape", given, named))

        client.changeVisualShape = watched


def build(client: BulletClient, looks: Looks) -> dict[int, int]:
    """Build a world that looks like the recorded one, without collision shapes.

    Bodies are built in reverse order, because the renderer draws in the order of building: objects
    before furniture, and furniture before walls and floors. It then saves the shading of surfaces
    that nearer ones hide.

    Returns:
        The ids of the bodies, by their ids in the recorded world.
    """
    return {body: _build(client, steps) for body, steps in reversed([*looks.items()])}


def _build(client: BulletClient, steps: Sequence[Step]) -> int:
    made = _NO_SHAPE
    for name, given, named in steps:
        match name:
            case "loadURDF":
                made = _load(client, *given, **named)
            case "createMultiBody":
                made = client.createMultiBody(_STATIC_MASS, _NO_SHAPE, made, *given, **named)
            case "changeVisualShape":
                client.changeVisualShape(made, *given, **named)
            case _:
                made = getattr(client, name)(*given, **named)
    return made


def _load(client: BulletClient, description: str, **named: Any) -> int:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.urdf")
        path.write_text(description)
        made: int = client.loadURDF(str(path), flags=_VISUAL_ONLY, **named)
    return made


@dataclass(frozen=True, slots=True)
class Moment:
    """The poses of all that moves.

    Attributes:
        bodies: poses of the bodies, in the order of `Actors`.
        joints: positions of the robot's movable joints (metres, radians), in its order.
    """

    bodies: tuple[Placed, ...] = ()
    joints: tuple[float, ...] = ()


class Actors:
    """All that moves in a world: rigid bodies, and one robot with joints."""

    def __init__(self, client: BulletClient, bodies: Sequence[int], robot: int) -> None:
        """Follow these bodies, given by their ids, and all movable joints of the robot."""
        self._client = client
        self.bodies = bodies
        self.robot = robot
        self._joints = _movable(client, robot)
        self._places: dict[int, Placed] = {}
        self._positions: dict[int, float] = {}

    def where(self) -> Moment:
        """The current poses."""
        place = self._client.getBasePositionAndOrientation
        states = self._client.getJointStates(self.robot, self._joints)
        return Moment(tuple(map(place, self.bodies)), tuple(state[0] for state in states))

    def put(self, moment: Moment) -> None:
        """Set the poses, which come from the recorded world."""
        for body, placed in zip(self.bodies, moment.bodies, strict=True):
            if self._places.get(body) != placed:
                self._client.resetBasePositionAndOrientation(body, *placed)
                self._places[body] = placed
        for joint, position in zip(self._joints, moment.joints, strict=True):
            if self._positions.get(joint) != position:
                self._client.resetJointState(self.robot, joint, position)
                self._positions[joint] = position


def _movable(client: BulletClient, robot: int) -> Sequence[int]:
    joints = range(client.getNumJoints(robot))
    return [joint for joint in joints if client.getJointInfo(robot, joint)[2] != p.JOINT_FIXED]
