"""What a world looks like, written down while it is built, so that another can be built like it.

Of ours it imports the engine alone, for it is also used by a process that does nothing else.
"""

import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from sim.engine import BulletClient
from sim.engine import pybullet as p

Step = tuple[str, tuple[Any, ...], dict[str, Any], int]
"""One of PyBullet's functions, what it was given, and the id that it returned."""
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
        self.steps: list[Step] = []
        """In the order in which they were done: ids and what is drawn over what depend on it."""
        self._watch(client, "createVisualShape")
        self._watch(client, "createVisualShapeArray")
        self._watch(client, "changeVisualShape")
        self._watch_bodies(client)
        self._watch_files(client)

    def _watch(self, client: BulletClient, name: str) -> None:
        do = getattr(client, name)

        def watched(*given: Any, **named: Any) -> Any:
            made = do(*given, **named)
            self.steps.append((name, given, named, made))
            return made

        setattr(client, name, watched)

    def _watch_bodies(self, client: BulletClient) -> None:
        do = client.createMultiBody

        def watched(mass: float, touched: int, seen: int, *given: Any, **named: Any) -> int:
            made: int = do(mass, touched, seen, *given, **named)
            self.steps.append(("createMultiBody", (_STAYS, _NO_SHAPE, seen, *given), named, made))
            return made

        client.createMultiBody = watched

    def _watch_files(self, client: BulletClient) -> None:
        do = client.loadURDF

        def watched(path: str, **named: Any) -> int:
            made: int = do(path, **named)
            self.steps.append(("loadURDF", (Path(path).read_text(),), named, made))
            return made

        client.loadURDF = watched


def build(client: BulletClient, steps: Iterable[Step]) -> None:
    """Build what looks like the world in which the steps were done; nothing in it can be touched.

    Raises:
        RuntimeError: if it turns out otherwise.
    """
    for name, given, named, expected in steps:
        if name == "loadURDF":
            made = _load(client, *given, **named)
        else:
            made = getattr(client, name)(*given, **named)
        if made != expected:
            raise RuntimeError(f"{name} made {made}, and not {expected}")


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
        bodies: by id.
        joints: of the robot, by number.
    """

    bodies: dict[int, Placed] = field(default_factory=dict)
    joints: dict[int, float] = field(default_factory=dict)


class Actors:
    """All that moves in a world: bodies, and one robot with joints."""

    def __init__(self, client: BulletClient, bodies: Iterable[int], robot: int) -> None:
        """Of bodies the whole moves, of the robot each joint that can."""
        self._client = client
        self.bodies = tuple(bodies)
        self.robot = robot
        self._joints = _movable(client, robot)
        self._now = Moment()

    def where(self) -> Moment:
        """Where they are."""
        place = self._client.getBasePositionAndOrientation
        states = self._client.getJointStates(self.robot, self._joints)
        return Moment(
            {body: place(body) for body in self.bodies},
            {joint: state[0] for joint, state in zip(self._joints, states, strict=True)},
        )

    def put(self, moment: Moment) -> None:
        """Have them be where they were in a world that this one looks like."""
        for body, placed in moment.bodies.items():
            if self._now.bodies.get(body) != placed:
                self._client.resetBasePositionAndOrientation(body, *placed)
        for joint, position in moment.joints.items():
            if self._now.joints.get(joint) != position:
                self._client.resetJointState(self.robot, joint, position)
        self._now = moment


def _movable(client: BulletClient, robot: int) -> Sequence[int]:
    joints = range(client.getNumJoints(robot))
    return [joint for joint in joints if client.getJointInfo(robot, joint)[2] != p.JOINT_FIXED]
