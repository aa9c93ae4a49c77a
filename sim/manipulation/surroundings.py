"""The arm's surroundings: furniture, objects that the camera sees, and where the base can stand."""

from collections.abc import Callable, Iterator

import numpy as np

from executive.geometry import Floats
from sim.body.base import RADIUS_M
from sim.body.hardware import Hardware
from sim.body.skill import CannotError
from sim.home.furniture import Furniture
from sim.home.home import Home
from sim.manipulation.clutter import CELL_M, Column, columns
from sim.manipulation.placing import FLAT_M
from sim.manipulation.planning import PlanningWorld
from sim.manipulation.reaching import floor_poses, plan_stance, standing_poses
from sim.objects.objects import ObjectModel

_BEFORE_M = 0.6
"""The robot uses furniture only if it is this near to the pose for using it."""
_ON_FLOOR_M, _NEAR_M = 0.3, 2.5
"""Objects this low and this near can be picked up from the floor."""


class Surroundings:
    """Combines the map of the home with the points of the depth camera."""

    def __init__(
        self,
        hardware: Hardware,
        planning: PlanningWorld,
        home: Home,
        scan: Callable[[], Floats],
    ) -> None:
        """Use these parts; `scan` returns the points (n, 3) in `map` that the camera sees now."""
        self._hardware = hardware
        self._planning = planning
        self._home = home
        self.scan = scan

    def furniture_below(self, points: Floats) -> Furniture | None:
        """The furniture that an object with these visible points is on; None if it is on the floor.

        Raises:
            CannotError: if it is out of reach: not on furniture in front of the robot, and not on
                the floor nearby.
        """
        middle = np.median(points, axis=0)
        x, y, _ = self._hardware.base_pose
        for piece in (*self._home.furniture, self._home.delivery):
            stand = self._home.stand(piece.name)
            if np.hypot(stand[0] - x, stand[1] - y) < _BEFORE_M and piece.is_below(tuple(middle)):
                return piece
        away = np.hypot(middle[0] - x, middle[1] - y)
        if away < RADIUS_M:
            raise CannotError("it lies on my own base")
        if middle[2] > _ON_FLOOR_M or away > _NEAR_M:
            raise CannotError("it is out of my reach")
        return None

    def rising_near(self, model: ObjectModel, points: Floats) -> Floats:
        """The points (m, 3) that the camera sees now near an object on the floor.

        Args:
            model: the object.
            points: (n, 3) points of it that were seen before.
        """
        x, y, _ = np.median(points, axis=0)
        seen = self.scan()
        near = np.hypot(seen[:, 0] - x, seen[:, 1] - y) < max(model.size)
        rises = (seen[:, 2] > FLAT_M) & (seen[:, 2] < max(model.size) + FLAT_M)
        mine = np.hypot(*(seen[:, :2] - self._hardware.base_pose[:2]).T) < RADIUS_M + FLAT_M
        closely: Floats = seen[near & rises & ~mine]
        return closely if len(closely) > len(points) else points

    def mind_clutter(self, piece: Furniture | None, target: Floats, seen: Floats) -> None:
        """Make the planner avoid what stands on the furniture.

        This changes the planning world: run it in a `Thinker`.

        Args:
            piece: the furniture; None for the floor, where no obstacles are added.
            target: points (n, 3) in `map` of the object that the hand reaches for.
            seen: all points (n, 3) in `map` that the depth camera sees.
        """
        near: list[Column] = []
        others: list[Column] = []
        for column in columns(piece, seen) if piece else ():
            off = np.abs(target[:, :2] - (column.x, column.y)).max(axis=1)
            (near if (off < CELL_M).any() else others).append(column)
        self._planning.assume_clutter(near, others)

    def stances(
        self, piece: Furniture | None, target: Floats, here: Floats
    ) -> Iterator[list[Floats]]:
        """Ways of the base from `here` to poses from which a point is in reach.

        The point is on furniture, or on the floor if `piece` is None. This takes long: run it in a
        `Thinker`.
        """
        for base in standing_poses(piece, target) if piece else floor_poses(here, target):
            way = plan_stance(self._planning, here, base)
            if way is not None:
                yield way


def support(piece: Furniture | None, points: Floats) -> float:
    """The height of the surface that an object with these visible points rests on (metres)."""
    middle = float(np.median(points[:, 2]))
    heights = [0.0, *(surface.center[2] for surface in piece.surfaces())] if piece else [0.0]
    return max(height for height in heights if height <= middle + CELL_M)
