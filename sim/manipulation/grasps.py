"""Finds grasps of a known object for a two-finger hand, from its shapes alone.

For each orientation of the hand, the object is cut by lines along the closing direction of the
fingers. Two fingers can grasp a section of a line that is inside the object, free on both sides and
not too long: all of a box, the wall of a mug, the handle of a pitcher.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from executive.geometry import Floats
from executive.types.geometry import Pose
from sim.body.hardware import FINGER_TRAVEL
from sim.bullet.client import GRAVITY_M_S2
from sim.objects.objects import ObjectModel
from sim.objects.solids import sample_surface, signed_distance

WIDEST = 2 * FINGER_TRAVEL - 0.0045
"""The widest section that fits between the open fingers (metres)."""
NARROWEST = 0.003
"""The narrowest section that the fingers can hold (metres)."""
TIP = 0.0075
"""Distance from the point between the pads to the finger tips (metres)."""
PALM = 0.037
"""Distance from the point between the pads back to the palm (metres)."""
_OPENING = 0.024
"""How much wider than the section the fingers open, if they can (metres)."""
_PAD_HALF_WIDTH, _FINGER_THICKNESS, _PAD_UP = 0.009, 0.022, 0.010
_MARGIN = 0.003
"""Least free space around the fingers, for errors of position (metres)."""
_PAD_GIVE = 0.003
"""The soft pad touches points up to this far behind the first contact (metres)."""
_FULL_PAD = 12
"""Least number of surface points under a pad that lies flat."""
_LOWEST_TIP, _EASY_TIP = 0.0025, 0.012
"""Least height of the finger tips above the support, and the height below which a grasp costs extra
(metres)."""
_FACING = 0.1
"""Points whose normal has a smaller component towards the finger than this are on other sides."""
_WITHIN_FRICTION = 0.85
"""Least cosine of the angle between surface normal and closing direction for a firm hold."""
_ALIKE_M, _ALIKE_TURN = 0.02, np.radians(20.0)
"""Grasps that differ by less than this (metres, radians) are alike; so are swapped fingers."""
_PALM_HALF_SIZE = (0.025, 0.105)
_STEP_X, _STEP_Y, _STEP_Z = 0.008, 0.001, 0.004
_DEEPEST = 0.06
Span = tuple[float, float]
LIGHTEST_GRIP_N, GRIP_N_KG = 5.0, 55.0
"""Force of each finger: a constant, and a part per kilogram of the object."""
TWIST_M = 0.004
"""Grasps far from the centre of mass need more force: two pads that press with a force resist a
torque of twice the force times this."""
TILTS = tuple(np.radians((0.0, 15.0, 30.0, 45.0, 60.0, 90.0)))
"""Tilts of the hand from straight down to level, away from the robot, in order of preference."""


@dataclass(frozen=True, slots=True)
class HandPose:
    """The point between the finger pads in `map`; z points out of the hand, y to a finger."""

    position: Floats
    rotation: Rotation

    @property
    def approach(self) -> Floats:
        """Unit vector (3,) in `map` that points out of the hand."""
        return np.asarray(self.rotation.apply((0.0, 0.0, 1.0)))

    def shifted(self, offset: Floats) -> "HandPose":
        """The same orientation, moved by an offset in `map` (metres)."""
        return HandPose(self.position + offset, self.rotation)


@dataclass(frozen=True, slots=True)
class Grasp:
    """A grasp.

    Attributes:
        hand: the pose at which the hand closes.
        gap: how far the fingers are open before (metres).
        cost: the lower, the better; 0 is ideal.
    """

    hand: HandPose
    gap: float
    cost: float

    @property
    def hands(self) -> tuple[HandPose, HandPose]:
        """The pose, and the pose turned by half a circle about z: both fingers are alike."""
        turned = self.hand.rotation * Rotation.from_euler("z", np.pi)
        return self.hand, HandPose(self.hand.position, turned)


def hand_rotation(yaw: float, tilt: float) -> Rotation:
    """The hand pointing down with its x axis to `yaw`, then tilted up by `tilt` towards there."""
    return Rotation.from_euler("ZYX", (yaw, -tilt, np.pi))


def find_grasps(model: ObjectModel, pose: Pose, facing: float, tilt: float) -> list[Grasp]:
    """Grasps of an object, the best first.

    Args:
        model: the object.
        pose: its pose in `map`.
        facing: the robot's yaw in `map`; the hand's yaw is within a quarter turn of it.
        tilt: tilt of the hand, one of TILTS (radians).
    """
    found = [
        grasp
        for yaw in _yaws(pose, facing, tilt)
        for grasp in _straddles(model, pose, hand_rotation(yaw, tilt))
    ]
    return sorted(found, key=lambda grasp: grasp.cost)


def varied(grasps: Iterable[Grasp], count: int) -> list[Grasp]:
    """The first `count` grasps, without those that are alike an earlier one."""
    kept: list[Grasp] = []
    for grasp in grasps:
        if len(kept) == count:
            break
        if not any(_alike(grasp.hand, other.hand) for other in kept):
            kept.append(grasp)
    return kept


def _alike(one: HandPose, other: HandPose) -> bool:
    if np.linalg.norm(one.position - other.position) > _ALIKE_M:
        return False
    turn = (one.rotation.inv() * other.rotation).magnitude()
    return bool(min(turn, np.pi - turn) < _ALIKE_TURN)


def _yaws(pose: Pose, facing: float, tilt: float) -> Iterator[float]:
    """Yaws of the hand in steps of 15 degrees, aligned with the object's axes."""
    own = Rotation.from_quat(pose.orientation).as_euler("ZYX")[0]
    for step in range(24):
        away = np.remainder(own + step * np.pi / 12 - facing + np.pi, 2 * np.pi) - np.pi
        if -np.pi / 2 < away <= np.pi / 2:
            yield facing + away


def _straddles(model: ObjectModel, pose: Pose, rotation: Rotation) -> Iterator[Grasp]:
    """All grasps with this orientation of the hand."""
    turn = Rotation.from_quat(pose.orientation)
    surface, outward = sample_surface(model.shapes)
    to_hand = rotation.inv() * turn
    points, normals = to_hand.apply(surface), to_hand.apply(outward)
    mass = to_hand.apply(model.center_of_mass)
    base = np.asarray(pose.position)
    low, high = points.min(axis=0), points.max(axis=0)
    xs = np.arange(low[0] + 0.003, high[0], _STEP_X)
    ys = np.arange(low[1] - 0.003, high[1] + 0.003, _STEP_Y)
    zs = np.arange(low[2] + 0.002, min(high[2], low[2] + _DEEPEST), _STEP_Z)
    grid = np.stack(np.meshgrid(xs, zs, ys, indexing="ij"), axis=-1)[..., (0, 2, 1)]
    inside = signed_distance(model.shapes, to_hand.inv().apply(grid.reshape(-1, 3))) < 0
    stretches = _stretches(inside.reshape(grid.shape[:-1]), ys)
    for x, plane in zip(xs, stretches, strict=True):
        near = np.abs(points[:, 0] - x) < _PALM_HALF_SIZE[0]
        beside, facing = points[near], normals[near]
        wholes = (
            (z, whole) for z, runs in zip(zs, plane, strict=True) for whole in _wholes(runs, model)
        )
        for z, (start, end) in wholes:
            middle = np.array([x, (start + end) / 2, z])
            gap = min(2 * FINGER_TRAVEL, end - start + _OPENING)
            if not NARROWEST < end - start < WIDEST or not _room(beside, middle, end - start, gap):
                continue
            position = base + rotation.apply(middle)
            tip_height = (position + TIP * rotation.apply((0.0, 0.0, 1.0)))[2]
            over_base = tip_height - base[2]
            if over_base < _LOWEST_TIP:
                continue
            grip = _grip(beside, facing, middle, end - start)
            if grip == 0.0:
                continue
            lever = np.linalg.norm((rotation.apply(mass - middle))[:2])
            shallow = max(0.0, low[2] + 0.04 - z)
            tight = max(0.0, end - start - 0.06)
            low_tip = max(0.0, _EASY_TIP - over_base)
            cost = float(lever + 0.03 * (1 - grip) + 0.2 * shallow + low_tip + tight)
            yield Grasp(HandPose(position, rotation), gap, cost)


def _stretches(inside: NDArray[np.bool_], ys: Floats) -> list[list[list[Span]]]:
    """Start and end (metres along y) of each section inside the object, by x, z and line."""
    edges = np.diff(np.pad(inside, ((0, 0), (0, 0), (1, 1))).astype(np.int8), axis=-1)
    half = _STEP_Y / 2
    return [
        [
            list(
                zip(
                    ys[np.flatnonzero(line == 1)] - half,
                    ys[np.flatnonzero(line == -1) - 1] + half,
                    strict=True,
                )
            )
            for line in plane
        ]
        for plane in edges
    ]


def _wholes(runs: list[Span], model: ObjectModel) -> Iterator[Span]:
    """Spans that can be between the fingers: sections and all between them, or only one wall.

    Objects with other grasps than `top` are taken by one wall.
    """
    if model.grasp == "top":
        for first, last in combinations_with_replacement(runs, 2):
            yield first[0], last[1]
    else:
        yield from runs


def _room(points: Floats, middle: Floats, width: float, gap: float) -> bool:
    """Whether palm and fingers can close without hitting the object beside the span.

    Args:
        points: (n, 3) surface points of the object in the hand's axes.
        middle: (3,) the point between the pads.
        width: of the span (metres).
        gap: opening of the fingers before they close (metres).
    """
    x, y, z = np.abs(points[:, 0] - middle[0]), points[:, 1] - middle[1], points[:, 2] - middle[2]
    palm = (x < _PALM_HALF_SIZE[0]) & (np.abs(y) < _PALM_HALF_SIZE[1]) & (z < -PALM)
    beside = (np.abs(y) > width / 2 + _MARGIN) & (np.abs(y) < gap / 2 + _FINGER_THICKNESS)
    fingers = (x < _PAD_HALF_WIDTH + _MARGIN) & beside & (z < TIP + _MARGIN)
    return not (palm | fingers).any()


def _grip(points: Floats, normals: Floats, middle: Floats, width: float) -> float:
    """Quality of the contacts: 1 if both pads lie flat on the object, 0 if it would slip."""
    x, z = np.abs(points[:, 0] - middle[0]), points[:, 2] - middle[2]
    opposite = (x < _PAD_HALF_WIDTH) & (z > -_PAD_UP) & (z < TIP)
    worst = 1.0
    for side in (-1.0, 1.0):
        away = np.abs(points[:, 1] - middle[1] - side * width / 2)
        flat = side * normals[opposite & (away < _PAD_GIVE), 1]
        flat = flat[flat > _FACING]
        if not len(flat) or flat.mean() < _WITHIN_FRICTION:
            return 0.0
        worst = min(worst, float(flat.mean()) * min(1.0, len(flat) / _FULL_PAD))
    return worst


def grip_force(model: ObjectModel, pose: Pose, hand: HandPose) -> float:
    """The force of each finger (newtons) for an object at `pose` in `map`, grasped at `hand`."""
    middle = Rotation.from_quat(pose.orientation).apply(model.center_of_mass) + pose.position
    torque = model.mass_kg * GRAVITY_M_S2 * float(np.linalg.norm((middle - hand.position)[:2]))
    return LIGHTEST_GRIP_N + GRIP_N_KG * model.mass_kg + torque / (2 * TWIST_M)
