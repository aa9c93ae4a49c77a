"""Finding where a known thing stands from the part of its surface that the camera saw."""

from typing import Literal

import numpy as np
from scipy.optimize import OptimizeResult, least_squares
from scipy.spatial.transform import Rotation

from executive.types import Pose
from sim.forms import forms
from sim.objects import ObjectModel
from sim.solids import Floats, signed_distance

_POINTS = 250
_YAW_STARTS = 12
_CENTERING = 0.1
"""Where the points leave a thing free to slide, their middle is that of the thing."""
_FITS_M = 0.008
"""A model that is off by less, in its surface and height together, is not doubted."""
_NOISE_M = 0.003
"""Points farther than this from the model count less and less (soft L1 loss)."""


def locate(model: ObjectModel, points: Floats) -> Pose:
    """The pose in `map` of an upright thing that fits its visible points (n, 3) best.

    Fits x, y, z and yaw so that the points lie on the model's surface. The yaw of a thing that
    looks the same from several sides is one of several.
    """
    return _locate(model, points)[0]


def locate_fallen(model: ObjectModel, points: Floats, support: float) -> tuple[ObjectModel, Pose]:
    """How a thing lies on what is `support` high (metres), and where.

    Returns:
        The one of `forms(model)` that fits the visible points (n, 3), and its pose in `map`.
    """
    best, least = (model, Pose()), np.inf
    for form in forms(model):
        pose, off = _locate(form, points)
        off += abs(pose.position[2] - support)
        if off < _FITS_M:
            return form, pose
        if off < least:
            best, least = (form, pose), off
    return best


def _locate(model: ObjectModel, points: Floats) -> tuple[Pose, float]:
    """The best pose of an upright thing, and how far the points are off its surface (metres)."""
    few = np.asarray(points[:: max(1, len(points) // _POINTS)], dtype=np.float64)
    middle = np.append((few.min(axis=0) + few.max(axis=0))[:2] / 2, few[:, 2].max() - model.size[2])
    starts = [np.append(middle, 2 * np.pi * i / _YAW_STARTS) for i in range(_YAW_STARTS)]
    coarse = min(
        (_fit(model, few[::3], start, "linear", 10) for start in starts), key=lambda fit: fit.cost
    )
    fit = _fit(model, few, coarse.x, "soft_l1", 50)
    x, y, z, yaw = (float(v) for v in fit.x)
    pose = Pose((x, y, z), (0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2))))
    return pose, float(np.abs(fit.fun[: len(few)]).mean())


def _fit(
    model: ObjectModel,
    points: Floats,
    start: Floats,
    loss: Literal["linear", "soft_l1"],
    evaluations: int,
) -> OptimizeResult:
    middle = (np.array(model.lower) + model.upper)[:2] / 2

    def distances(guess: Floats) -> Floats:
        turn = Rotation.from_euler("z", guess[3]).as_matrix()
        local = (points - guess[:3]) @ turn
        off_middle = (local.min(axis=0) + local.max(axis=0))[:2] / 2 - middle
        return np.append(signed_distance(model.shapes, local), _CENTERING * off_middle)

    return least_squares(
        distances,
        start,
        loss=loss,
        f_scale=_NOISE_M,
        max_nfev=evaluations,
        x_scale=(0.01, 0.01, 0.01, 0.2),
    )
