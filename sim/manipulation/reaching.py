"""Plans where the base stands and how the arm moves, to bring the hand to a grasp or a spot."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import TypeVar

import numpy as np

from executive.geometry import Floats
from sim.home.furniture import Furniture
from sim.manipulation.grasps import HandPose
from sim.manipulation.planning import CHECKED, PlanningWorld

APPROACH_M = (0.12, 0.05, 0.025)
"""Lengths of the last straight part of a reach, in order of preference."""
NEAREST_M = 0.40
"""Distance from the front edge of furniture to the centre of the robot that reaches for it."""
BACK_OFF_M = 0.24
"""How far the base retreats, if possible, before the arm is folded."""
OVER_M = (0.15, 0.3, 0.45)
"""How much higher the lift can go to bring the arm in from above, in order of preference."""
ASIDE_M = (0.0, 0.15, -0.15, 0.3, -0.3)
"""Offsets of the base to the left of the object, in order of preference."""
FLOOR_REACH_M = 0.55
"""Distance from an object on the floor to the centre of the robot that picks it up."""
FLOOR_BEARINGS = tuple(np.radians((0.0, 45.0, -45.0, 90.0, -90.0, 135.0, -135.0, 180.0)))
"""Directions from which it is picked up, relative to that of the robot now (radians)."""
_SIMPLE_TRIES, _ROUNDABOUTS, _SAMPLES = 24, 12, 300
"""How many reaches are tried with simple paths, how many of them then with RRT-Connect, and with
how many random samples each."""
COMFORT: Floats = np.array([0.15, 0.0, 0.1, 0.0, -2.0, 0.0, 2.1, 0.785])
"""The arm bent, the hand pointing down in front of the robot; inverse kinematics starts from it."""
_ELBOW_RIGHT: Floats = np.array([0.1, -0.7, 0.5, 0.9, -1.6, -0.4, 1.8, 0.785])
_ELBOW_LEFT: Floats = np.array([0.1, 0.7, 0.5, -0.9, -1.6, 0.4, 1.8, 0.785])
POSTURES = ((COMFORT,), (_ELBOW_RIGHT, _ELBOW_LEFT))
"""Start postures of inverse kinematics, in order of preference: between boards there is more room
beside the elbow than above the hand."""
Aim = TypeVar("Aim")


@dataclass(frozen=True, slots=True)
class Reach:
    """A planned motion of the hand to a pose; all points are joint positions of `ARM`.

    Attributes:
        hand: the pose.
        path: to a point above the pose, or in front of it.
        last: from there to the pose, in a straight line.
    """

    hand: HandPose
    path: list[Floats]
    last: list[Floats]

    @property
    def way_back(self) -> list[Floats]:
        """The last, straight part in reverse."""
        return [*reversed(self.last[:-1]), self.path[-1]]


@dataclass(frozen=True, slots=True, eq=False)
class Approach:
    """Where the base stands, and possible poses for the hand to close or open at.

    Attributes:
        stance: poses (x, y, yaw) that the base passes; at the last it stops.
        hands: alternative poses of the hand.
        way: (3,) displacement of the hand in the last, straight part (metres, in `map`).
    """

    stance: list[Floats]
    hands: tuple[HandPose, ...]
    way: Floats

    @property
    def base(self) -> Floats:
        """The final pose of the base."""
        return self.stance[-1]


@dataclass(frozen=True, slots=True, eq=False)
class _LastPart:
    """The last straight part of a reach, joint positions from its start to its end."""

    hand: HandPose
    joints: list[Floats]


def standing_poses(piece: Furniture, target: Floats, near_m: float = NEAREST_M) -> Iterator[Floats]:
    """Poses (x, y, yaw) of the base from which the arm may reach a point on the furniture."""
    x, y, yaw = piece.pose
    out, left = np.array([np.cos(yaw), np.sin(yaw)]), np.array([-np.sin(yaw), np.cos(yaw)])
    along = float((target[:2] - (x, y)) @ left)
    for aside in ASIDE_M:
        spot = np.array([x, y]) + (piece.size[0] / 2 + near_m) * out + (along + aside) * left
        yield np.append(spot, yaw + np.pi)


def floor_poses(here: Floats, target: Floats) -> Iterator[Floats]:
    """Poses (x, y, yaw) of the base, facing a point on the floor, the nearest to `here` first."""
    from_target = here[:2] - target[:2]
    bearing = float(np.arctan2(from_target[1], from_target[0]))
    for aside in FLOOR_BEARINGS:
        out = np.array([np.cos(bearing + aside), np.sin(bearing + aside)])
        yaw = np.remainder(bearing + aside + 2 * np.pi, 2 * np.pi) - np.pi
        yield np.append(target[:2] + FLOOR_REACH_M * out, _nearest_turn(here[2], yaw))


def _nearest_turn(here: float, yaw: float) -> float:
    """The equivalent of a yaw that is nearest to the robot's yaw `here` (radians)."""
    return here + float(np.remainder(yaw - here + np.pi, 2 * np.pi) - np.pi)


def plan_stance(world: PlanningWorld, here: Floats, base: Floats) -> list[Floats] | None:
    """Base poses to pass from `here` to `base` without collision; None if there are none.

    The way is straight, or first ahead and then aside, or first aside and then ahead.
    """
    ahead = np.array([np.cos(base[2]), np.sin(base[2]), 0.0])
    advance = ((base - here) @ ahead) * ahead
    for between in ([], [here + advance], [base - advance]):
        way = [*between, base]
        if world.drive_obstacle([here, *way]) is None:
            return way
    return None


def plan_retreat(world: PlanningWorld, here: Floats) -> Floats:
    """The pose farthest back, up to BACK_OFF_M, that the base can reach in a straight line."""
    ahead = np.array([np.cos(here[2]), np.sin(here[2]), 0.0])
    for part in (1.0, 0.75, 0.5, 0.25):
        back: Floats = here - part * BACK_OFF_M * ahead
        if world.drive_obstacle([here, back]) is None:
            return back
    return here


def choose_approach(
    world: PlanningWorld, start: Floats, options: Callable[[], Iterable[tuple[Aim, Approach]]]
) -> tuple[Aim, Approach] | None:
    """The first approach for which a simple path exists; if none, one with a path by RRT-Connect.

    Args:
        world: for collision checks and kinematics.
        start: start positions of the joints of `ARM`.
        options: returns the possible aims and their approaches, the best first.
    """
    for postures in POSTURES:
        nearly: list[tuple[Aim, Approach, _LastPart]] = []
        for aim, approach in options():
            for last in _last_parts(world, approach, postures):
                if clear_path(world, approach.base, start, last.joints[0]):
                    return aim, approach
                nearly.append((aim, approach, last))
            if len(nearly) >= _SIMPLE_TRIES:
                break
        for aim, approach, last in nearly[:: _SIMPLE_TRIES // _ROUNDABOUTS]:
            if _roundabout(world, approach.base, start, last.joints[0]):
                return aim, approach
    return None


def plan_reach(world: PlanningWorld, start: Floats, approach: Approach) -> Reach | None:
    """Plan a collision-free motion from joint positions `start` of `ARM`, by a chosen approach."""
    for postures in POSTURES:
        lasts = list(_last_parts(world, approach, postures))
        for plan, last in product((clear_path, _roundabout), lasts):
            path = plan(world, approach.base, start, last.joints[0])
            if path is not None:
                return Reach(last.hand, path, last.joints[1:])
    return None


def _last_parts(
    world: PlanningWorld, approach: Approach, postures: Iterable[Floats]
) -> Iterator[_LastPart]:
    """Collision-free straight motions to the end of an approach.

    At their start the arm keeps the usual margin, so that a path can end there.
    """
    base = approach.base
    for posture, target in product(postures, approach.hands):
        end = world.solve(base, target, posture)
        if end is None or not world.is_last_part_free(base, [end]):
            continue
        before = world.solve(base, target.shifted(-approach.way), end)
        if before is None or world.obstacle(base, before):
            continue
        joints = world.line(base, before, target)
        if joints and world.is_last_part_free(base, joints):
            yield _LastPart(target, joints)


def clear_path(
    world: PlanningWorld, base: Floats, start: Floats, end: Floats
) -> list[Floats] | None:
    """Joint positions to pass from start to end, without collision; None if there is no such path.

    The path is straight in joint space, or goes over raised positions of the lift.
    """
    highest = world.limits[1][0]
    tops = [max(start[0], end[0]), *(min(end[0] + over, highest) for over in OVER_M)]
    ways = [[np.append(top, start[1:]), np.append(top, end[1:])] for top in tops]
    for between in ([], ways[0][:1], *ways):
        path = [*between, end]
        if not world.path_obstacle(base, [start, *path]):
            return path
    return None


def any_path(world: PlanningWorld, base: Floats, start: Floats, end: Floats) -> list[Floats] | None:
    """Joint positions to pass from start to end, without collision; None if none are found."""
    return clear_path(world, base, start, end) or _roundabout(world, base, start, end)


def _roundabout(
    world: PlanningWorld, base: Floats, start: Floats, end: Floats
) -> list[Floats] | None:
    from sim.manipulation.rrt import connect  # slow to import, and most missions do not need it

    lower, upper = world.limits
    found = connect(
        start / CHECKED,
        end / CHECKED,
        lower / CHECKED,
        upper / CHECKED,
        lambda joints: not world.obstacle(base, joints * CHECKED),
        _SAMPLES,
    )
    return found and [joints * CHECKED for joints in found[1:]]
