"""Grasps, spots, base poses and obstacles from the known shapes of things and furniture.

For a robot that can plan motions, but has no skills of its own.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import islice

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats, carried_by, pose_from
from executive.records import Shape
from executive.ros.arm import Hold, Planar
from executive.ros.moveit import Obstacle
from executive.types.geometry import Pose, Vector3
from executive.types.perception import Detection
from sim.home.furniture import Furniture
from sim.home.home import Home
from sim.objects.objects import ObjectModel

EYE_M = 1.2
"""The approximate height of the camera above the base (metres)."""
WAYS, SPOTS = 4, 8
"""The largest number of grasps for each tilt of the hand, and of spots for each surface."""
ON_FLOOR_M = 0.3
"""A thing below this height (metres) that is not on the furniture before the robot is on the
floor."""
AROUND_M = 2.5
"""Furniture that is farther away is no obstacle for the arm (metres)."""


class KnownThings:
    """Implements `Hands` with the shapes of the home's objects, as the simulated robot does.

    What it uses is slow to import, and is imported when it is needed.
    """

    def __init__(self, home: Home) -> None:
        """Use the objects and furniture of this home."""
        self._home = home

    @cached_property
    def _models(self) -> dict[str, ObjectModel]:
        return self._home.drawn_models()

    def grasps(self, detection: Detection, base: Pose) -> Sequence[Hold]:
        """Grasps for a detected thing, the best first: from above before horizontal.

        Empty if its shape is not known, or it was not located.
        """
        model = self._models.get(detection.label)
        if model is None or not len(detection.points):
            return ()
        return tuple(self._holds(model, detection, base))

    def _holds(self, model: ObjectModel, detection: Detection, base: Pose) -> Iterator[Hold]:
        from sim.manipulation.grasps import TILTS, find_grasps, grip_force, varied
        from sim.manipulation.registration import fit_pose

        eye = np.add(base.position, (0.0, 0.0, EYE_M))
        thing = fit_pose(model, detection.points.astype(np.float64), eye)
        box = _box(model)
        facing = float(Rotation.from_quat(base.orientation).as_euler("ZYX")[0])
        for tilt in TILTS:
            for grasp in varied(find_grasps(model, thing, facing, tilt), WAYS):
                for hand in grasp.hands:
                    where = pose_from(hand.position, hand.rotation)
                    yield Hold(where, grasp.gap, thing, box, grip_force(model, thing, hand))

    def spots(self, place: str, label: str, seen: Floats) -> Sequence[Pose]:
        """Poses (in `map`) in which the thing can stand, for each surface the easiest first."""
        from sim.manipulation.placing import free_spots

        piece, model = self._home.furniture_named(place), self._models[label]
        return tuple(
            spot
            for surface in piece.surfaces()
            for spot in islice(free_spots(piece, surface, model, seen), SPOTS)
        )

    def stances(
        self, place: str | None, point: Vector3, base: Pose, near_m: float
    ) -> Sequence[Planar]:
        """Base poses (in `map`) in front of the furniture, opposite the point.

        They are around the point if it is on the floor, or if `place` is no furniture.
        """
        from sim.manipulation.reaching import floor_poses, standing_poses

        target, piece = np.array(point), self._piece(place)
        if piece is None or (point[2] < ON_FLOOR_M and not piece.is_below(point)):
            yaw = Rotation.from_quat(base.orientation).as_euler("ZYX")[0]
            poses = floor_poses(np.array([*base.position[:2], yaw]), target)
        else:
            poses = standing_poses(piece, target, near_m)
        return [(float(x), float(y), float(yaw)) for x, y, yaw in poses]

    def _piece(self, place: str | None) -> Furniture | None:
        """The furniture of this name; None if `place` is None, or is not furniture."""
        pieces = (*self._home.furniture, self._home.delivery)
        return next((piece for piece in pieces if piece.name == place), None)

    def obstacles(self, base: Pose) -> Sequence[Obstacle]:
        """The shapes of the furniture around the robot, in `map`."""
        x, y, _ = base.position
        pieces = (*self._home.furniture, self._home.delivery)
        return [
            Obstacle(piece.name, replace(shape, pose=carried_by(piece.frame(), shape.pose)))
            for piece in pieces
            if math.dist(piece.pose[:2], (x, y)) < AROUND_M
            for shape in piece.shapes()
        ]


def _box(model: ObjectModel) -> Shape:
    """The bounding box of a thing, in its own frame."""
    x, y, z = ((low + high) / 2 for low, high in zip(model.lower, model.upper, strict=True))
    return Shape("box", model.size, (0.0, 0.0, 0.0, 1.0), Pose((x, y, z)))
