"""Faults of the physics world: moves objects, shuts doors and puts down crates."""

from collections.abc import Iterator, Mapping

import numpy as np

from executive.colors import Color
from executive.records import Entity, Shape
from executive.types.geometry import Pose
from sim.body.skill import CONTROL_S
from sim.bullet.bodies import create_body, frame_pose, put_at
from sim.engine import BulletClient, pybullet
from sim.faults.hardware import FaultyHardware
from sim.faults.injector import FaultInjector
from sim.faults.orders import Blocked, Crate, Moved
from sim.home.floorplan import Door, doors_between, wall_axis, wall_lines
from sim.home.furniture import box
from sim.home.home import Home

DOOR_HEIGHT_M, DOOR_THICKNESS_M = 2.0, 0.04
DOOR_COLOR: Color = (0.62, 0.45, 0.28, 1.0)
DOOR_SPEED_M_S = 1.0
CRATE_M = (0.5, 0.5, 0.6)
CRATE_COLOR: Color = (0.80, 0.62, 0.30, 1.0)
CLEAR_M = 1.0
"""Doors are not shut, and crates not put down, while the robot is nearer than this."""
_CELLAR = Pose((0.0, 0.0, -3.0))
"""Crates wait here, below the floor, until their time comes."""


class WorldFaults:
    """The faults that happen in the world, not in a sensor or motor of the robot."""

    def __init__(
        self,
        client: BulletClient,
        home: Home,
        things: Mapping[int, str],
        hardware: FaultyHardware,
        injector: FaultInjector,
    ) -> None:
        """Create the doors that will be shut, still open, and the crates, below the floor.

        Args:
            client: the world.
            home: its plan.
            things: names of the movable objects by body id.
            hardware: the robot; doors and crates must not hit it.
            injector: the faults and their times.
        """
        self._client = client
        self._home = home
        self._bodies = {name: body for body, name in things.items()}
        self._hardware = hardware
        self._injector = injector
        self._slide = DOOR_SPEED_M_S * CONTROL_S
        self._shapes: dict[str, Shape] = {}
        self._doors = {f: self._hang(f) for f in injector.ordered(Blocked)}
        self._crates = {f: self._store(f) for f in injector.ordered(Crate)}

    def bodies(self) -> dict[int, str]:
        """Names of doors and crates by body id."""
        doors = {leaf.body: _name(fault) for fault, leaf in self._doors.items()}
        return {**doors, **{body: _name(fault) for fault, body in self._crates.items()}}

    def entities(self) -> Iterator[Entity]:
        """Doors and crates for the viewer, each in a frame of its own name."""
        return (Entity(name, name, (shape,)) for name, shape in self._shapes.items())

    def act(self) -> None:
        """Apply the faults that are due; called once per control period."""
        self._hardware.misbehave()
        for moved in self._injector.due(Moved):
            self._injector.strike(moved, self._move(moved))
        for fault, leaf in self._doors.items():
            self._slide_door(fault, leaf)
        for crate, body in self._crates.items():
            self._place_crate(crate, body)

    # --- objects ---

    def _move(self, fault: Moved) -> str:
        body = self._bodies[fault.thing]
        if body in self._hardware.touched():
            return f"the robot has the {fault.thing}: it stays"
        put_at(self._client, body, fault.pose(self._home))
        self._client.changeDynamics(body, -1, activationState=pybullet.ACTIVATION_STATE_WAKE_UP)
        return f"the {fault.thing} is taken to {fault.place}"

    # --- doors ---

    def _hang(self, fault: Blocked) -> "_Leaf":
        doors = doors_between(self._home.rooms, self._home.doors)
        door = next(door for door, rooms in doors.items() if set(rooms) == set(fault.rooms))
        return _Leaf(door, self._build(fault, *_leaf_shape(self._home, door)))

    def _slide_door(self, fault: Blocked, leaf: "_Leaf") -> None:
        shut = fault in self._injector.active(Blocked)
        if shut and leaf.open == leaf.door.width:
            if self._robot_is_at(leaf.door.position):
                return
            self._injector.strike(fault, f"the door {fault.value} is shut")
        left = np.clip((0.0 if shut else leaf.door.width) - leaf.open, -self._slide, self._slide)
        if left:
            leaf.open += float(left)
            self._put(leaf.body, _leaf_pose(self._home, leaf.door, leaf.open))

    # --- crates ---

    def _store(self, fault: Crate) -> int:
        middle = (0.0, 0.0, CRATE_M[2] / 2)
        return self._build(fault, box(CRATE_M, middle, CRATE_COLOR), _CELLAR)

    def _place_crate(self, fault: Crate, body: int) -> None:
        there = frame_pose(self._client, body) != _CELLAR
        wanted = fault in self._injector.active(Crate)
        if wanted == there or (wanted and self._robot_is_at((fault.x, fault.y))):
            return
        if wanted:
            self._injector.strike(fault, f"a crate stands at {fault.value}")
        self._put(body, Pose((fault.x, fault.y, 0.0)) if wanted else _CELLAR)

    # --- helpers ---

    def _build(self, fault: Blocked | Crate, shape: Shape, pose: Pose) -> int:
        self._shapes[_name(fault)] = shape
        return create_body(self._client, (shape,), pose)

    def _put(self, body: int, pose: Pose) -> None:
        self._client.resetBasePositionAndOrientation(body, pose.position, pose.orientation)

    def _robot_is_at(self, point: tuple[float, float]) -> bool:
        x, y, _ = self._hardware.base_pose
        return bool(np.hypot(x - point[0], y - point[1]) < CLEAR_M)


class _Leaf:
    """A door that slides into the wall beside it; `open` is the width of its gap (metres)."""

    def __init__(self, door: Door, body: int) -> None:
        self.door = door
        self.body = body
        self.open = door.width


def _name(fault: Blocked | Crate) -> str:
    return f"{fault.word}_{fault.value}"


def _leaf_shape(home: Home, door: Door) -> tuple[Shape, Pose]:
    lengths = [door.width, door.width, DOOR_HEIGHT_M]
    lengths[wall_axis(door, wall_lines(home.rooms)) or 0] = DOOR_THICKNESS_M
    leaf = box((lengths[0], lengths[1], lengths[2]), (0.0, 0.0, DOOR_HEIGHT_M / 2), DOOR_COLOR)
    return leaf, _leaf_pose(home, door, door.width)


def _leaf_pose(home: Home, door: Door, opened: float) -> Pose:
    x, y = door.position
    along_y = wall_axis(door, wall_lines(home.rooms)) == 0
    return Pose((x + opened * (not along_y), y + opened * along_y, 0.0))
