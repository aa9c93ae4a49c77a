"""Choosing a grasp, or a spot to put a thing down, together with an approach to it.

All of this takes long, and only plans: a `Thinker` computes it. The robot and the simulator are
never touched here, so what the robot sees and where it stands comes as a `View`.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from itertools import islice, product

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats
from executive.types.geometry import Pose
from sim.body.hardware import FOLDED
from sim.body.skill import CannotError
from sim.home.furniture import Furniture, Surface
from sim.manipulation.grasps import TILTS, WIDEST, Grasp, HandPose, find_grasps, varied
from sim.manipulation.hand import Held
from sim.manipulation.placing import free_spots
from sim.manipulation.planning import PlanningWorld
from sim.manipulation.reaching import APPROACH_M, Approach, choose_approach
from sim.manipulation.surroundings import Surroundings
from sim.objects.objects import ObjectModel
from sim.objects.solids import sample_surface

DOWN = np.array([0.0, 0.0, -1.0])
NO_POINTS: Floats = np.empty((0, 3))
_GOOD = 0.06
"""Grasps of a higher cost are tried only if no better one can be reached."""
_GRASPS_TRIED = 8
"""How many grasps are tried for each stance and tilt, as different from each other as can be."""
_SPOTS_TRIED, _BATCHES = 12, 4
"""Free spots are tried in batches: how many spots in each, and how many batches."""
_UPRIGHT = 0.99
"""Cosine of the tilt up to which a hand points down."""


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """What the robot sees before it chooses, and from where.

    Attributes:
        points: what the depth camera sees (n, 3), in `map` (metres).
        base: where it stands: x, y (metres) and yaw (radians) in `map`.
    """

    points: Floats
    base: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Target:
    """A thing to grasp: its `pose` in `map` was fitted to the `points` (n, 3) seen of it."""

    model: ObjectModel
    pose: Pose
    points: Floats


class Chooser:
    """Goes through grasps and spots, the best first, until there is a way to one."""

    def __init__(self, planning: PlanningWorld, around: Surroundings) -> None:
        """Plan in this world, which nothing else may use at the same time."""
        self._planning = planning
        self._around = around

    def grasp(
        self,
        target: Target,
        piece: Furniture | None,
        view: View,
        has_missed: Callable[[Grasp], bool],
    ) -> tuple[Grasp, Approach]:
        """The best grasp that can be reached, and an approach to it.

        The target is on `piece` (None: on the floor). Grasps that have missed before come last.

        Raises:
            CannotError: if there is no grasp, or no way to any.
        """
        model, pose = target.model, target.pose
        taken = np.concatenate((target.points, _surface(model, pose)))
        self._around.mind_clutter(piece, taken, view.points)
        stances = list(self._around.stances(piece, np.asarray(pose.position), view.base))

        @cache
        def grasps(facing: float, tilt: float) -> list[Grasp]:
            new_first = sorted(find_grasps(model, pose, facing, tilt), key=has_missed)
            return varied(new_first, _GRASPS_TRIED)

        def options(good: bool) -> Iterator[tuple[Grasp, Approach]]:
            for tilt, stance in product(TILTS, stances):
                some = [g for g in grasps(float(stance[-1][2]), tilt) if (g.cost < _GOOD) == good]
                for grasp, length in product(some, APPROACH_M):
                    yield grasp, Approach(stance, grasp.hands, length * grasp.hand.approach)

        for good in (True, False):
            chosen = choose_approach(self._planning, FOLDED, partial(options, good))
            if chosen:
                return chosen
        if stances and not any(grasps(float(stances[0][-1][2]), tilt) for tilt in TILTS):
            wide = ": it is wider than my hand opens" if min(model.size[:2]) > WIDEST else ""
            raise CannotError(f"I cannot grasp the {model.name} as it lies{wide}")
        raise CannotError(f"I cannot reach the {model.name}")

    def spot(
        self, held: Held, piece: Furniture, surface: Surface, view: View, arm: Floats
    ) -> tuple[tuple[Pose, Approach] | None, bool]:
        """A free spot on a surface of `piece`, with an approach; and whether any spot is free.

        The approach begins with the joints `arm`. There is none if no free spot can be reached.
        """
        self._around.mind_clutter(piece, NO_POINTS, view.points)
        free = free_spots(piece, surface, held.model, view.points, held.turn)
        any_free = False
        for _ in range(_BATCHES):
            spots = list(islice(free, _SPOTS_TRIED))
            any_free = any_free or bool(spots)
            ways = partial(self.ways_to_spots, held, piece, spots, view.base)
            chosen = choose_approach(self._planning, arm, ways)
            if chosen or len(spots) < _SPOTS_TRIED:
                return chosen, any_free
        return None, any_free

    def ways_to_spots(
        self, held: Held, piece: Furniture, spots: list[Pose], base: Floats
    ) -> Iterator[tuple[Pose, Approach]]:
        """Approaches that bring the thing to these spots, from where the base stands."""
        for spot in spots:
            hand = held.hand_for(spot)
            stances = self._around.stances(piece, np.asarray(spot.position), base)
            for stance, way in product(stances, _ways_to_put(hand)):
                yield spot, Approach(stance, (hand,), way)


def _surface(model: ObjectModel, pose: Pose) -> Floats:
    """Points (n, 3) all over a thing at `pose` in `map`: the camera saw only one side of it."""
    points, _ = sample_surface(model.shapes)
    surface: Floats = Rotation.from_quat(pose.orientation).apply(points[::5]) + pose.position
    return surface


def _ways_to_put(hand: HandPose) -> list[Floats]:
    """Last straight ways of a hand that puts a thing down: from above, or along a tilted hand."""
    directions = [DOWN] if hand.approach @ DOWN > _UPRIGHT else [hand.approach, DOWN]
    return [length * direction for direction, length in product(directions, APPROACH_M)]
