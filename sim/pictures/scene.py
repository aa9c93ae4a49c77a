"""What a world looks like, written down while it is built, so that another can be built like it.

Of ours it imports the engine alone, for it is also used by a process that does nothing else.
"""

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sim.engine import BulletClient
from sim.engine import pybullet as p

Step = tuple[str, tuple[Any, ...], dict[str, Any]]
"""One of PyBullet's functions, and what it was given beside what the step before had made."""
Looks = Mapping[int, Sequence[Step]]
"""How each body of a world came to look as it does, by its id, in the order they were built."""
Placed = tuple[tuple[float, ...], tuple[float, ...]]
"""Position and orientation of a body."""

_NO_SHAPE = -1
_STAYS = 0.0
"""The mass of what no physics moves."""
_ONLY_SEEN = p.URDF_IGNORE_COLLISION_SHAPES


class Blueprint:
    """Writes down what is built in a world from now on, as far as it can be seen."""

    def __init__(self, client: BulletClient) -> None:
        """Nothing is in that world yet."""
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
    """Build what looks like the world that was written down; nothing in it can be touched.

    It is built in reverse, for what is built first is drawn first. So things come before furniture,
    and that before walls and floors: of what something nearer hides no colours are worked out.

    Returns:
        The bodies' ids, by those in that world.
    """
    return {body: _build(client, steps) for body, steps in reversed([*looks.items()])}


def _build(client: BulletClient, steps: Sequence[Step]) -> int:
    made = _NO_SHAPE
    for name, given, named in steps:
        match name:
            case "loadURDF":
                made = _load(client, *given, **named)
            case "createMultiBody":
                made = client.createMultiBody(_STAYS, _NO_SHAPE, made, *given, **named)
            case "changeVisualShape":
                client.changeVisualShape(made, *given, **named)
            case _:
                made = getattr(client, name)(*given, **named)
    return made


def _load(client: BulletClient, description: str, **named: Any) -> int:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.urdf")
        path.write_text(description)
        made: int = client.loadURDF(str(path), flags=_ONLY_SEEN, **named)
    return made


@dataclass(frozen=True, slots=True)
class Moment:
    """Where everything is that moves.

    Attributes:
        bodies: in the order of the Actors.
        joints: those of the robot that can move, in its order.
    """

    bodies: tuple[Placed, ...] = ()
    joints: tuple[float, ...] = ()


class Actors:
    """All that moves in a world: bodies, and one robot with joints."""

    def __init__(self, client: BulletClient, bodies: Sequence[int], robot: int) -> None:
        """Of bodies the whole moves, of the robot each joint that can."""
        self._client = client
        self.bodies = bodies
        self.robot = robot
        self._joints = _movable(client, robot)
        self._places: dict[int, Placed] = {}
        self._positions: dict[int, float] = {}

    def where(self) -> Moment:
        """Where they are."""
        place = self._client.getBasePositionAndOrientation
        states = self._client.getJointStates(self.robot, self._joints)
        return Moment(tuple(map(place, self.bodies)), tuple(state[0] for state in states))

    def put(self, moment: Moment) -> None:
        """Have them be where those were of a world that this one looks like."""
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
