"""How known things are held and where they can stand, for a robot with motions but no skills."""

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import islice

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats, pose_from
from executive.ros.arm import Hold
from executive.types import Detection, Pose
from sim.home.home import Home
from sim.objects.objects import ObjectModel

EYE_M = 1.2
"""Things are seen from about so high above the base."""
WAYS, SPOTS = 4, 8
"""So many different grasps of each tilt of the hand, and so many spots of a surface, are told."""


class KnownThings:
    """Implements `Hands` by the shapes of the home's objects, as the simulated robot has them.

    Its parts take long to import, and only such a robot needs them.
    """

    def __init__(self, home: Home) -> None:
        """Nothing is computed before it is asked for."""
        self._home = home

    @cached_property
    def _models(self) -> dict[str, ObjectModel]:
        return self._home.drawn_models()

    def grasps(self, detection: Detection, base: Pose) -> Sequence[Hold]:
        """Ways to hold what is seen, the best first: straight down before level."""
        model = self._models.get(detection.label)
        if model is None or not len(detection.points):
            return ()
        return tuple(self._holds(model, detection, base))

    def _holds(self, model: ObjectModel, detection: Detection, base: Pose) -> Iterator[Hold]:
        from sim.manipulation.grasps import TILTS, find_grasps, varied
        from sim.manipulation.registration import fit_pose

        eye = np.add(base.position, (0.0, 0.0, EYE_M))
        thing = fit_pose(model, detection.points.astype(np.float64), eye)
        facing = float(Rotation.from_quat(base.orientation).as_euler("ZYX")[0])
        for tilt in TILTS:
            for grasp in varied(find_grasps(model, thing, facing, tilt), WAYS):
                for hand in grasp.hands:
                    yield Hold(pose_from(hand.position, hand.rotation), grasp.gap, thing)

    def spots(self, place: str, label: str, seen: Floats) -> Sequence[Pose]:
        """Where on a place the thing can stand, the handiest first."""
        from sim.manipulation.placing import free_spots

        piece, model = self._home.furniture_named(place), self._models[label]
        return tuple(
            spot
            for surface in piece.surfaces()
            for spot in islice(free_spots(piece, surface, model, seen), SPOTS)
        )
