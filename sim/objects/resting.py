"""The resting poses of an object: upright on its base, or fallen onto another side."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats, pose_from, vector3
from executive.records import Shape
from executive.types.geometry import Pose
from sim.objects.objects import ObjectModel
from sim.objects.solids import sample_surface

_FALLS = (("x", 90.0), ("x", -90.0), ("y", 90.0), ("y", -90.0), ("x", 180.0))
"""Rotations from upright onto each of the other sides (axis, degrees)."""


@dataclass(frozen=True, slots=True, eq=False)
class Lying:
    """A resting pose.

    Attributes:
        shapes: the shapes of the upright object, in its frame.
        model: the model of the lying object, which rests on its own base.
        fall: rotation matrix (3, 3) from upright to lying.
        base: centre of the new base in the object frame, after that rotation (metres).
    """

    shapes: tuple[Shape, ...]
    model: ObjectModel
    fall: Floats
    base: Floats


@cache
def lyings(model: ObjectModel) -> tuple[Lying, ...]:
    """All resting poses of an object, upright first."""
    stands = Lying(model.shapes, model, np.eye(3), np.zeros(3))
    return (stands, *(_fallen(model, Rotation.from_euler(a, d, degrees=True)) for a, d in _FALLS))


def _fallen(model: ObjectModel, fall: Rotation) -> Lying:
    """The resting pose after a fall, with the origin of the model at the centre of the new base."""
    surface = fall.apply(sample_surface(model.shapes)[0])
    low, high = surface.min(axis=0), surface.max(axis=0)
    base = np.append((low[:2] + high[:2]) / 2, low[2])
    shapes = tuple(replace(shape, pose=_moved(shape.pose, fall, base)) for shape in model.shapes)
    lies = replace(
        model,
        grasp="top" if model.grasp == "top" else "rim",
        shapes=shapes,
        lower=vector3(low - base),
        upper=vector3(high - base),
        center_of_mass=vector3(fall.apply(model.center_of_mass) - base),
    )
    return Lying(model.shapes, lies, fall.as_matrix(), base)


def _moved(pose: Pose, fall: Rotation, base: Floats) -> Pose:
    turn = fall * Rotation.from_quat(pose.orientation)
    return pose_from(fall.apply(pose.position) - base, turn)
