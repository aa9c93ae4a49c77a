"""Finding where a known thing stands from the part of its surface that the camera saw."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial

import numpy as np
from scipy.optimize import OptimizeResult, least_squares
from scipy.spatial.transform import Rotation

from executive.geometry import Floats
from executive.types import Pose
from sim.objects.objects import ObjectModel
from sim.objects.resting import forms
from sim.objects.solids import signed_distance

_POINTS = 250
_YAWS, _BEHIND = 12, (0.0, 0.5, 1.0)
"""How many yaws are guessed; how far behind what is seen the middle may be (of half the depth)."""
_NUDGES_M = (0.0, 0.02, -0.02, 0.04, -0.04)
"""How far from the best of these, along the view, the fit is tried again: it may be stuck there."""
_CENTERING = 0.1
"""Where the points leave a thing free to slide, their middle is that of the thing."""
_PROBE_M = 5e-4
_SEED = 0
_FITS_M = 0.008
"""A model that is off by less, in its surface and height together, is not doubted."""
_NOISE_M = 0.003
"""Points farther than this from the model count less and less (soft L1 loss)."""
Off = Callable[[Floats], Floats]


def fit_pose(model: ObjectModel, points: Floats, eye: Floats) -> Pose:
    """The pose in `map` of an upright thing that fits its visible points (n, 3) best.

    Fits x, y, z and yaw so that the points lie on the side of the model that `eye` (3,), where the
    camera is in `map`, can see. The yaw of a thing that looks the same from several sides is one of
    several.
    """
    return _fit_pose(model, points, eye)[0]


def fit_fallen_pose(
    model: ObjectModel, points: Floats, eye: Floats, support: float
) -> tuple[ObjectModel, Pose]:
    """How a thing lies on what is `support` high (metres), and where.

    Returns:
        The one of `forms(model)` that fits the visible points (n, 3), and its pose in `map`.
    """
    best, least = (model, Pose()), np.inf
    for form in forms(model):
        pose, off = _fit_pose(form, points, eye)
        off += abs(pose.position[2] - support)
        if off < _FITS_M:
            return form, pose
        if off < least:
            best, least = (form, pose), off
    return best


def _fit_pose(model: ObjectModel, points: Floats, eye: Floats) -> tuple[Pose, float]:
    """The best pose of an upright thing, and how far the points are off its surface (metres)."""
    order = np.random.default_rng(_SEED).permutation(len(points))
    few = np.asarray(points[order[:_POINTS]], dtype=np.float64)
    off, roughly = partial(_off, model, few), partial(_off, model, few[::3])
    middle = (few.min(axis=0) + few.max(axis=0))[:2] / 2
    away = (middle - eye[:2]) / np.linalg.norm(middle - eye[:2])

    def best(fits: Iterable[OptimizeResult]) -> OptimizeResult:
        return min(fits, key=lambda fit: (_turned_away(model, few, eye, fit.x), fit.cost))

    starts = _starts(model, np.append(middle, few[:, 2].max()), away, roughly)
    coarse = best(_fit(roughly, start, 10) for start in starts)
    nudges = [np.array([*(nudge * away), 0.0, 0.0]) for nudge in _NUDGES_M]
    fit = best(_fit(off, coarse.x + nudge, 50) for nudge in nudges)
    x, y, z, yaw = (float(v) for v in fit.x)
    pose = Pose((x, y, z), (0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2))))
    return pose, float(np.abs(off(fit.x)[: len(few)]).mean())


def _starts(model: ObjectModel, top: Floats, away: Floats, off: Off) -> Iterator[Floats]:
    """A guess (x, y, z, yaw) for each yaw: below the middle of what is seen, or behind that."""
    middle, bottom = top[:2], top[2] - model.size[2]
    for yaw in np.arange(_YAWS) * 2 * np.pi / _YAWS:
        along = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]]) @ away
        half = np.abs(along) @ np.array(model.size[:2]) / 2
        guesses = [np.array([*(middle + part * half * away), bottom, yaw]) for part in _BEHIND]
        yield min(guesses, key=lambda guess: float((off(guess) ** 2).sum()))


def _off(model: ObjectModel, points: Floats, guess: Floats) -> Floats:
    """How far points (n, 3) are off the model's surface, and their middle off its own (n + 2,)."""
    local = _local(guess, points)
    middle = (np.array(model.lower) + model.upper)[:2] / 2
    off_middle = (local.min(axis=0) + local.max(axis=0))[:2] / 2 - middle
    return np.append(signed_distance(model.shapes, local), _CENTERING * off_middle)


def _turned_away(model: ObjectModel, points: Floats, eye: Floats, guess: Floats) -> bool:
    """Whether most of the points are on sides of the model that the eye cannot see."""
    local = _local(guess, points)
    normals = np.column_stack(
        [
            signed_distance(model.shapes, local + step)
            - signed_distance(model.shapes, local - step)
            for step in _PROBE_M * np.eye(3)
        ]
    )
    facing = ((_local(guess, eye) - local) * normals).sum(axis=1) > 0
    return bool(facing.mean() < 0.5)


def _local(guess: Floats, points: Floats) -> Floats:
    """Points (..., 3) of `map` in the frame of a thing at (x, y, z, yaw)."""
    local: Floats = (points - guess[:3]) @ Rotation.from_euler("z", guess[3]).as_matrix()
    return local


def _fit(off: Off, start: Floats, evaluations: int) -> OptimizeResult:
    scale = (0.01, 0.01, 0.01, 0.2)
    return least_squares(
        off, start, loss="soft_l1", f_scale=_NOISE_M, max_nfev=evaluations, x_scale=scale
    )
