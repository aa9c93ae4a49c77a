"""How a thing may lie: on its base, as it is put down, or fallen on one of its other sides."""

from dataclasses import replace
from functools import cache

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats
from executive.types import Pose, Vector3
from sim.objects.objects import ObjectModel
from sim.objects.solids import sample_surface

_FALLS = (("x", 90.0), ("x", -90.0), ("y", 90.0), ("y", -90.0), ("x", 180.0))
"""From standing to each of the other sides (axis, degrees)."""


@cache
def forms(model: ObjectModel) -> tuple[ObjectModel, ...]:
    """The thing as it stands, then as it may lie: each a model that rests on its own base."""
    return (model, *(_fallen(model, Rotation.from_euler(a, d, degrees=True)) for a, d in _FALLS))


def _fallen(model: ObjectModel, fall: Rotation) -> ObjectModel:
    """The model turned, with the origin in the middle of what is now its base."""
    surface = fall.apply(sample_surface(model.shapes)[0])
    low, high = surface.min(axis=0), surface.max(axis=0)
    base = np.append((low[:2] + high[:2]) / 2, low[2])
    shapes = tuple(replace(shape, pose=_moved(shape.pose, fall, base)) for shape in model.shapes)
    return replace(
        model,
        grasp="top" if model.grasp == "top" else "rim",
        shapes=shapes,
        lower=_vector(low - base),
        upper=_vector(high - base),
        center_of_mass=_vector(fall.apply(model.center_of_mass) - base),
    )


def _moved(pose: Pose, fall: Rotation, base: Floats) -> Pose:
    x, y, z, w = (float(v) for v in (fall * Rotation.from_quat(pose.orientation)).as_quat())
    return Pose(_vector(fall.apply(pose.position) - base), (x, y, z, w))


def _vector(values: Floats) -> Vector3:
    x, y, z = (float(v) for v in values)
    return x, y, z
