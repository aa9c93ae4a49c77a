"""Picking things up and putting them down: the recipes.

What the hand does follows from what the camera saw, the known shapes of things and the map of the
home. What comes of it is up to physics.
"""

from collections.abc import Callable, Generator, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from itertools import islice, product
from typing import TypeVar

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats, vector3
from executive.types.geometry import Pose
from executive.types.perception import Detection
from sim.body.arm import SLOW, follow
from sim.body.base import CREEPING, drive
from sim.body.hardware import FINGER_TRAVEL, FOLDED, Hardware
from sim.body.head import look_at
from sim.body.skill import CannotError, Skill, Thinker, attempt, pause, wait_until
from sim.home.furniture import Furniture, Surface
from sim.home.home import Home
from sim.manipulation.clutter import over
from sim.manipulation.grasps import TILTS, WIDEST, Grasp, HandPose, find_grasps, grip_force, varied
from sim.manipulation.hand import CLOSING_S, SETTLING_S, Hand, Held, LostError
from sim.manipulation.placing import free_spots, stands
from sim.manipulation.planning import PlanningWorld
from sim.manipulation.reaching import (
    Approach,
    Reach,
    any_path,
    choose_approach,
    plan_reach,
    plan_retreat,
)
from sim.manipulation.registration import fit_fallen_pose
from sim.manipulation.surroundings import Surroundings, support
from sim.objects.objects import ObjectModel, why_not_taken
from sim.objects.solids import sample_surface

APPROACH_M = (0.12, 0.05, 0.025)
"""Lengths of the last straight part of a reach, in order of preference."""
RISES_M = (0.10, 0.05, 0.02)
"""How far the hand goes up before the robot backs off, in order of preference."""
_RETREATS = 2
"""How often the robot backs off to fold its arm."""
FEWEST_POINTS = 30
"""A thing of which fewer points were seen is not well enough seen to be grasped."""
_GOOD = 0.06
"""Grasps that cost more are tried only if no better one can be reached."""
_GRASPS_TRIED = 8
"""So many, of as different kinds as there are, are looked at for a way to them."""
_SPOTS_TRIED, _TIMES = 12, 4
"""How many free spots are tried together, and how often, where none of them is in reach."""
_FOLDED_WITHIN = 0.05
"""Farther than this from the folded pose (any joint but the last), the arm is out."""
_ALIKE = np.radians(30.0)
"""Grasps whose hands are turned by less are the same approach."""
_UPRIGHT = 0.99
"""Cosine of the tilt up to which a hand points down."""
_DOWN = np.array([0.0, 0.0, -1.0])
_NOTHING: Floats = np.empty((0, 3))
T = TypeVar("T")
_CARRY_TURNS = (FOLDED[7] + np.pi / 2, FOLDED[7] - np.pi / 2)
"""Values of the last joint that put the long side of a held thing across the robot (radians)."""


class Manipulator:
    """The arm's skills."""

    def __init__(
        self,
        hardware: Hardware,
        planning: PlanningWorld,
        home: Home,
        models: Mapping[str, ObjectModel],
        scan: Callable[[], Floats],
        thinker: Thinker,
    ) -> None:
        """Use these parts; `scan` gives the points (n, 3) in `map` that the depth camera sees.

        The planning world is used by what is computed, only: never by two threads at once.
        """
        self._hardware = hardware
        self._planning = planning
        self._home = home
        self._models = models
        self._around = Surroundings(hardware, planning, home, scan)
        self._thinker = thinker
        self.hand = Hand(hardware)
        self._missed: list[tuple[str, Rotation]] = []

    @property
    def handling(self) -> bool:
        """Whether the arm is out or something is in the hand."""
        return self.hand.grips or not self._is_folded

    @property
    def _is_folded(self) -> bool:
        off = np.abs(self._hardware.arm_positions - FOLDED)[:-1]
        return bool(off.max() < _FOLDED_WITHIN)

    def pick(self, detection: Detection) -> Skill:
        """Grasp the detected thing, lift it, and fold the arm.

        If it is in the hand already, since the arm could not be folded with it, only that is left.

        Raises:
            CannotError: if it is unknown, not well seen, out of reach, or slips.
        """
        self.hand.settle()
        held = self.hand.held
        if held and held.model.name == detection.label:
            yield from self.stow()
            return
        model = self._model_of(detection)
        points = np.asarray(detection.points, dtype=np.float64)
        piece = self._around.furniture_below(points)
        if piece is None:
            yield from self._face(np.median(points, axis=0))
            points = self._around.rising_near(model, points)
        else:
            yield from self._look_at(np.median(points, axis=0))
        eye = np.asarray(self._hardware.link_pose("camera_link").position)
        lies = partial(fit_fallen_pose, model, points, eye, support(piece, points))
        model, pose = yield from self._thinker.compute(lies)
        grasp, approach = yield from self._choose_grasp(model, pose, points, piece)
        yield from self._creep(approach.stance)
        tare = yield from self.hand.weigh()
        failure = yield from attempt(self._grasp(model, pose, grasp, approach))
        yield from self.stow()
        failure = failure or (yield from attempt(self._check_lifted(model, tare)))
        if failure:
            self._missed.append((model.name, grasp.hand.rotation))
            raise failure
        self._missed.clear()

    def put_down(self, place: str) -> Skill:
        """Put the held thing on a free spot of a piece of furniture, near the front if it can.

        Raises:
            CannotError: if nothing is held, or there is no free spot within reach.
        """
        self.hand.settle()
        held = self.hand.held
        if held is None:
            unknown = "I do not know what is in my hand"
            raise CannotError(unknown if self.hand.holding else "my hand is empty")
        yield from self.stow()
        piece = self._home.furniture_named(place)
        target, approach = yield from self._choose_spot(held, piece)
        yield from self._creep(approach.stance)
        failure = yield from attempt(self._release(approach, held.gap))
        yield from self.stow()
        if failure:
            raise failure
        if self.hand.holding:
            raise CannotError(f"the {held.model.name} stuck to my fingers")
        yield from self._check_stands(held.model, target, piece)

    def stow(self) -> Skill:
        """Bring the arm back over the base: rise, back off, fold.

        Raises:
            CannotError: if the arm would touch something; it stays out.
        """
        if self._is_folded:
            return
        hardware = self._hardware
        up = yield from self._planned(
            partial(self._way_up, hardware.base_pose, hardware.arm_positions)
        )
        if up:
            yield from follow(hardware, up, SLOW)
        for _ in range(_RETREATS):
            back = partial(plan_retreat, self._planning, hardware.base_pose)
            yield from self._creep([(yield from self._planned(back))])
            arm, folded = hardware.arm_positions, FOLDED.copy()
            folded[7] = min(_CARRY_TURNS, key=lambda turn: abs(turn - arm[7]))
            path = yield from self._planned(
                partial(any_path, self._planning, hardware.base_pose, arm, folded)
            )
            if path is not None:
                yield from follow(hardware, path)
                return
        raise CannotError("I cannot fold my arm without touching anything")

    # --- steps of a pick ---

    def _model_of(self, detection: Detection) -> ObjectModel:
        name = detection.label
        if self.hand.holding:
            held = self.hand.held
            thing = f"the {held.model.name}" if held else "a thing"
            raise CannotError(f"my hand already holds {thing}")
        if name not in self._models:
            raise CannotError(f"I do not know how to grasp the {name}")
        if len(detection.points) < FEWEST_POINTS:
            raise CannotError(f"I could not see the {name} well enough")
        if why := why_not_taken(self._models[name]):
            raise CannotError(f"I cannot grasp the {name} as it lies: {why}")
        return self._models[name]

    def _face(self, point: Floats) -> Skill:
        """Turn to a point on the floor, and look at it."""
        here = self._hardware.base_pose
        ahead = point[:2] - here[:2]
        yield from self._creep([np.append(here[:2], np.arctan2(ahead[1], ahead[0]))])
        yield from self._look_at(point)

    def _look_at(self, point: Floats) -> Skill:
        yield from look_at(self._hardware, vector3(point))

    def _choose_grasp(
        self, model: ObjectModel, pose: Pose, points: Floats, piece: Furniture | None
    ) -> Generator[None, None, tuple[Grasp, Approach]]:
        """A grasp, and how to get to it. Approaches that missed before come last."""
        seen = self._around.scan() if piece else _NOTHING
        here = self._hardware.base_pose
        chosen = partial(self._best_grasp, model, pose, points, piece, seen, here)
        return (yield from self._planned(chosen))

    def _best_grasp(
        self,
        model: ObjectModel,
        pose: Pose,
        points: Floats,
        piece: Furniture | None,
        seen: Floats,
        here: Floats,
    ) -> tuple[Grasp, Approach]:
        target = np.concatenate((points, _surface(model, pose)))
        self._around.mind_clutter(piece, target, seen)
        stances = list(self._around.stances(piece, np.asarray(pose.position), here))

        @cache
        def grasps(facing: float, tilt: float) -> list[Grasp]:
            found = find_grasps(model, pose, facing, tilt)
            new_first = sorted(found, key=lambda grasp: self._has_missed(model, grasp))
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

    def _grasp(self, model: ObjectModel, pose: Pose, grasp: Grasp, approach: Approach) -> Skill:
        hardware, name = self._hardware, model.name
        reach = yield from self._reach(approach, f"I cannot reach the {name}")
        self.hand.open(grasp.gap)
        yield from follow(hardware, reach.path)
        yield from follow(hardware, reach.last, SLOW)
        facing = float(hardware.base_pose[2])
        held = Held.taken(model, pose, reach.hand, grasp.gap, facing)
        self.hand.close_on(held, grip_force(model, pose, reach.hand))
        yield from self.hand.until_still()
        if not self.hand.touches:
            self.hand.open(grasp.gap)
            yield from follow(hardware, reach.way_back, SLOW)
            raise CannotError(f"I could not get hold of the {name}")

    def _check_lifted(self, model: ObjectModel, tare: float) -> Skill:
        """See whether the thing is in the hand: felt by the fingers, and by its weight."""
        if self.hand.holding:
            weight = (yield from self.hand.weigh()) - tare
            if self.hand.is_lifted(model, weight):
                return
            self.hand.open(2 * FINGER_TRAVEL)
            yield from wait_until(lambda: not self.hand.holding, CLOSING_S)
        self.hand.settle()
        raise CannotError(f"the {model.name} slipped from my fingers")

    # --- steps of putting down ---

    def _choose_spot(
        self, held: Held, piece: Furniture
    ) -> Generator[None, None, tuple[Pose, Approach]]:
        """Look, then choose where to put the thing, and how to get there."""
        carrying, any_free = self._hardware.arm_positions, False
        for surface, middle in zip(
            piece.surfaces(), self._home.view_targets(piece.name), strict=True
        ):
            yield from look_at(self._hardware, middle)
            seen, here = self._around.scan(), self._hardware.base_pose
            found = partial(self._best_spot, held, piece, surface, carrying, seen, here)
            chosen, is_free = yield from self._planned(found)
            any_free = any_free or is_free
            if chosen:
                return chosen
        clause = "I cannot reach a free spot on" if any_free else "I see no free spot on"
        raise CannotError(f"{clause} the {piece.name}")

    def _best_spot(
        self,
        held: Held,
        piece: Furniture,
        surface: Surface,
        carrying: Floats,
        seen: Floats,
        here: Floats,
    ) -> tuple[tuple[Pose, Approach] | None, bool]:
        """A spot on a surface and how to get there, if there is one; and whether any is free."""
        self._around.mind_clutter(piece, _NOTHING, seen)
        free = free_spots(piece, surface, held.model, seen, held.turn)
        any_free = False
        for _ in range(_TIMES):
            spots = list(islice(free, _SPOTS_TRIED))
            any_free = any_free or bool(spots)
            ways = partial(self._ways_to_spots, held, piece, spots, here)
            chosen = choose_approach(self._planning, carrying, ways)
            if chosen or len(spots) < _SPOTS_TRIED:
                return chosen, any_free
        return None, any_free

    def _ways_to_spots(
        self, held: Held, piece: Furniture, spots: list[Pose], here: Floats
    ) -> Iterator[tuple[Pose, Approach]]:
        for spot in spots:
            hand = held.hand_for(spot)
            stances = self._around.stances(piece, np.asarray(spot.position), here)
            for stance, way in product(stances, _ways_to_put(hand)):
                yield spot, Approach(stance, (hand,), way)

    def _release(self, approach: Approach, gap: float) -> Skill:
        hardware = self._hardware
        reach = yield from self._reach(approach, "I cannot reach a free spot")
        yield from self.hand.keep(follow(hardware, reach.path))
        weight = yield from self.hand.weigh()
        set_down = partial(self.hand.meets, weight)
        yield from self.hand.keep(follow(hardware, reach.last, SLOW, set_down))
        self.hand.open(gap)
        yield from wait_until(lambda: not self.hand.touches, CLOSING_S)
        yield from pause(SETTLING_S)
        yield from follow(hardware, reach.way_back, SLOW)

    def _check_stands(self, model: ObjectModel, spot: Pose, piece: Furniture) -> Skill:
        """Look whether what was put down stands where it was put."""
        yield from look_at(self._hardware, spot.position)
        height = spot.position[2]
        board = min(piece.surfaces(), key=lambda surface: abs(surface.center[2] - height))
        fault = stands(model, spot, over(piece, self._around.scan()), board.clearance)
        if fault:
            raise LostError(f"the {model.name} {fault} on the {piece.name}")

    # --- helpers ---

    def _planned(self, work: Callable[[], T]) -> Generator[None, None, T]:
        """Have something planned, with what is in the hand."""
        held = self.hand.held

        def plan() -> T:
            if held is None:
                self._planning.carry((), None)
            else:
                self._planning.carry(held.model.shapes, HandPose(held.position, held.rotation))
            return work()

        return (yield from self._thinker.compute(plan))

    def _way_up(self, base: Floats, arm: Floats) -> list[Floats] | None:
        """Joints that raise the hand as far as there is room: what it reached for is in it now."""
        self._planning.forget_target()
        hand = self._planning.hand(base, arm)
        for rise in RISES_M:
            up = self._planning.line(base, arm, hand.shifted(-rise * _DOWN))
            if up and self._planning.is_last_part_free(base, up[1:]):
                return up[1:]
        return None

    def _reach(self, approach: Approach, otherwise: str) -> Generator[None, None, Reach]:
        """The motion by an approach from where the robot stands now."""
        here = replace(approach, stance=[self._hardware.base_pose])
        plan = partial(plan_reach, self._planning, self._hardware.arm_positions, here)
        reach = yield from self._planned(plan)
        if reach is None:
            raise CannotError(otherwise)
        return reach

    def _creep(self, way: list[Floats]) -> Skill:
        """Drive slowly, straight from pose to pose."""
        for x, y, yaw in way:
            yield from drive(self._hardware, [(x, y)], yaw, CREEPING)

    def _has_missed(self, model: ObjectModel, grasp: Grasp) -> bool:
        """Whether the thing was missed with the hand turned like this."""
        return any(
            name == model.name and (rotation.inv() * grasp.hand.rotation).magnitude() < _ALIKE
            for name, rotation in self._missed
        )


def _surface(model: ObjectModel, pose: Pose) -> Floats:
    """Points (n, 3) all over a thing at `pose` in `map`: more of it is there than was seen."""
    points, _ = sample_surface(model.shapes)
    surface: Floats = Rotation.from_quat(pose.orientation).apply(points[::5]) + pose.position
    return surface


def _ways_to_put(hand: HandPose) -> list[Floats]:
    """Last straight ways of the hand with a thing: from above, or the way a tilted hand points."""
    directions = [_DOWN] if hand.approach @ _DOWN > _UPRIGHT else [hand.approach, _DOWN]
    return [length * direction for direction, length in product(directions, APPROACH_M)]
