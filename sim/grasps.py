"""Where a two-finger hand can take a known thing, from its shape alone.

For each orientation of the hand the thing is cut by lines along the way of the fingers. A stretch of
a line that is inside the thing, free on both sides and not too long is what two fingers can
straddle: the whole of a box, the wall of a mug, the handle of a pitcher.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations_with_replacement, product

import numpy as np
from scipy.spatial.transform import Rotation

from executive.types import Pose
from sim.hardware import FINGER_TRAVEL
from sim.objects import ObjectModel
from sim.solids import Floats, sample_surface, signed_distance

WIDEST = 2 * FINGER_TRAVEL - 0.006
"""The widest stretch that the open fingers pass on both sides (metres)."""
NARROWEST = 0.003
TIP = 0.0075
"""From the point between the pads to the tips of the fingers (metres)."""
PALM = 0.037
"""From the point between the pads back to the palm (metres)."""
_OPENING = 0.024
"""How much wider than the thing the fingers are opened, if they can."""
_FINGER_HALF_WIDTH, _FINGER_THICKNESS = 0.011, 0.020
_PALM_HALF_SIZE = (0.025, 0.105)
_STEP_X, _STEP_Y, _STEP_Z = 0.008, 0.001, 0.004
_DEEPEST = 0.06
TILTS = (0.0, np.pi / 4, np.pi / 2)
"""From straight down to level, away from the robot (radians), in order of preference."""


@dataclass(frozen=True, slots=True)
class HandPose:
    """The point between the finger pads in `map`; z points out of the hand, y across the fingers."""

    position: Floats
    rotation: Rotation

    @property
    def approach(self) -> Floats:
        """Unit vector in `map` along which the hand reaches out."""
        return np.asarray(self.rotation.apply((0.0, 0.0, 1.0)))

    def shifted(self, offset: Floats) -> "HandPose":
        """The same orientation, moved by an offset in `map` (metres)."""
        return HandPose(self.position + offset, self.rotation)


@dataclass(frozen=True, slots=True)
class Grasp:
    """Where the hand closes, how far the fingers are open before, and how poor it is (0 is ideal)."""

    hand: HandPose
    gap: float
    cost: float


def hand_rotation(yaw: float, tilt: float) -> Rotation:
    """The hand pointing down, its x axis to `yaw`, tilted up by `tilt` towards there (radians)."""
    return Rotation.from_euler("ZYX", (yaw, -tilt, np.pi))


def find_grasps(model: ObjectModel, pose: Pose, facing: float, tilt: float) -> list[Grasp]:
    """Grasps of a thing that stands at `pose` in `map`, best first.

    Args:
        model: its shape.
        pose: where it stands.
        facing: yaw in `map` that the robot faces; hands that are not level may have any yaw.
        tilt: of the hand, one of TILTS (radians).
    """
    found = [
        grasp
        for yaw in _yaws(pose, facing, tilt)
        for grasp in _straddles(model, pose, hand_rotation(yaw, tilt))
    ]
    return sorted(found, key=lambda grasp: grasp.cost)


def _yaws(pose: Pose, facing: float, tilt: float) -> Iterator[float]:
    """Yaws in steps of 15 degrees with the thing's own axes among them."""
    own = Rotation.from_quat(pose.orientation).as_euler("ZYX")[0]
    reach = np.pi / 2 if tilt == 0.0 else np.pi / 4
    for step in range(24):
        away = np.remainder(own + step * np.pi / 12 - facing + np.pi, 2 * np.pi) - np.pi
        if -reach < away <= reach:
            yield facing + away


def _straddles(model: ObjectModel, pose: Pose, rotation: Rotation) -> Iterator[Grasp]:
    """All stretches that the hand can take in this orientation."""
    turn = Rotation.from_quat(pose.orientation)
    surface, _ = sample_surface(model.shapes)
    to_hand = rotation.inv() * turn
    points = to_hand.apply(surface)
    mass = to_hand.apply(model.center_of_mass)
    base = np.asarray(pose.position)
    low, high = points.min(axis=0), points.max(axis=0)
    xs = np.arange(low[0] + 0.003, high[0], _STEP_X)
    ys = np.arange(low[1] - 0.003, high[1] + 0.003, _STEP_Y)
    zs = np.arange(low[2] + 0.002, min(high[2], low[2] + _DEEPEST), _STEP_Z)
    grid = np.stack(np.meshgrid(xs, zs, ys, indexing="ij"), axis=-1)[..., (0, 2, 1)]
    inside = signed_distance(model.shapes, to_hand.inv().apply(grid.reshape(-1, 3))) < 0
    stretches = _stretches(inside.reshape(grid.shape[:-1]), ys)
    for i, k in product(range(len(xs)), range(len(zs))):
        for first, last in combinations_with_replacement(stretches[i][k], 2):
            start, end = first[0], last[1]
            middle = np.array([xs[i], (start + end) / 2, zs[k]])
            gap = min(2 * FINGER_TRAVEL, end - start + _OPENING)
            if not NARROWEST < end - start < WIDEST or not _room(points, middle, gap):
                continue
            position = base + rotation.apply(middle)
            tip_height = (position + TIP * rotation.apply((0.0, 0.0, 1.0)))[2]
            if tip_height < base[2] + 0.002:
                continue
            slant = _slant(stretches, i, k, start, end)
            lever = np.linalg.norm((rotation.apply(mass - middle))[:2])
            shallow = max(0.0, low[2] + 0.04 - zs[k])
            tight = max(0.0, end - start - 0.06)
            cost = float(lever + 3 * slant + 0.2 * shallow + tight)
            yield Grasp(HandPose(position, rotation), gap, cost)


Stretches = list[list[list[tuple[float, float]]]]


def _stretches(inside: np.ndarray, ys: Floats) -> Stretches:
    """Start and end (metres along y) of each run of points inside the thing, for each line."""
    edges = np.diff(np.pad(inside, ((0, 0), (0, 0), (1, 1))).astype(np.int8), axis=-1)
    half = _STEP_Y / 2
    return [
        [
            list(zip(ys[np.flatnonzero(line == 1)] - half, ys[np.flatnonzero(line == -1) - 1] + half, strict=True))
            for line in plane
        ]
        for plane in edges
    ]


def _room(points: Floats, middle: Floats, gap: float) -> bool:
    """Whether palm and open fingers would not hit the thing."""
    x, y, z = np.abs(points[:, 0] - middle[0]), points[:, 1] - middle[1], points[:, 2] - middle[2]
    palm = (x < _PALM_HALF_SIZE[0]) & (np.abs(y) < _PALM_HALF_SIZE[1]) & (z < -PALM)
    beside = np.abs(np.abs(y) - gap / 2 - _FINGER_THICKNESS / 2) < _FINGER_THICKNESS / 2
    fingers = (x < _FINGER_HALF_WIDTH) & beside & (z < TIP + 0.002)
    return not (palm | fingers).any()


def _slant(stretches: Stretches, i: int, k: int, start: float, end: float) -> float:
    """How far the two sides lean or bulge over the width and length of the pads (metres)."""
    worst = 0.0
    for di, dk in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        if not (0 <= i + di < len(stretches) and 0 <= k + dk < len(stretches[0])):
            worst += 0.002
            continue
        near = [s for s in stretches[i + di][k + dk] if s[1] > start and s[0] < end]
        if not near:
            worst += 0.002
            continue
        worst += abs(near[0][0] - start) + abs(near[-1][1] - end)
    return worst / 4
