"""Picking things up and putting them down, step by step.

What the hand does follows from what the camera saw, the known shapes of things and the map of the
home. Whether a thing is then in the hand, or stands, is up to physics, and is checked.
"""

from collections.abc import Callable, Generator, Mapping
from dataclasses import replace
from functools import partial
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
from sim.home.furniture import Furniture
from sim.home.home import Home
from sim.manipulation.choosing import DOWN, NO_POINTS, Chooser, Target, View
from sim.manipulation.clutter import over
from sim.manipulation.grasps import Grasp, HandPose, grip_force
from sim.manipulation.hand import CLOSING_S, SETTLING_S, Hand, Held, LostError
from sim.manipulation.placing import stands
from sim.manipulation.planning import PlanningWorld
from sim.manipulation.reaching import Approach, Reach, any_path, plan_reach, plan_retreat
from sim.manipulation.registration import fit_fallen_pose
from sim.manipulation.surroundings import Surroundings, support
from sim.objects.objects import ObjectModel, why_not_taken

RISES_M = (0.10, 0.05, 0.02)
"""How far the hand goes up before the robot backs off, in order of preference."""
_RETREATS = 2
"""How often the robot backs off to fold its arm."""
FEWEST_POINTS = 30
"""A thing is grasped only if the camera saw at least this many points of it."""
_FOLDED_WITHIN = 0.05
"""The arm is folded if all joints but the last are this near to the folded pose (m, radians)."""
_ALIKE = np.radians(30.0)
"""Grasps are alike if the hand is turned by less than this between them."""
T = TypeVar("T")
_CARRY_TURNS = (FOLDED[7] + np.pi / 2, FOLDED[7] - np.pi / 2)
"""Values of the last joint that put the long side of a held thing across the robot (radians)."""


class Manipulator:
    """The skills of arm and hand: pick, put down and stow.

    Attributes:
        hand: what is in the hand.
    """

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

        Only what the `thinker` computes may use the planning world: so no two threads ever do.
        """
        self._hardware = hardware
        self._planning = planning
        self._home = home
        self._models = models
        self._around = Surroundings(hardware, planning, home, scan)
        self._chooser = Chooser(planning, self._around)
        self._thinker = thinker
        self.hand = Hand(hardware)
        self._missed: list[tuple[str, Rotation]] = []
        """Names of things that were missed since the last success, and how the hand was turned."""

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

        If it is already in the hand because the arm could not be folded, only fold the arm.

        Raises:
            CannotError: if the thing is unknown, not well seen or out of reach, or slips.
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
        grasp, approach = yield from self._choose_grasp(Target(model, pose, points), piece)
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
        """Put the held thing on a free spot of a piece of furniture, near the front if possible.

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
        """Bring the arm back over the base: raise the hand, back off, fold the arm.

        Raises:
            CannotError: if the arm would touch something; it stays stretched out.
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
        self, target: Target, piece: Furniture | None
    ) -> Generator[None, None, tuple[Grasp, Approach]]:
        """Look around, then choose a grasp and an approach to it."""
        view = View(self._around.scan() if piece else NO_POINTS, self._hardware.base_pose)
        has_missed = partial(self._has_missed, target.model)
        grasp = partial(self._chooser.grasp, target, piece, view, has_missed)
        return (yield from self._planned(grasp))

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
        """Check that the thing is in the hand: by touch, and by its weight."""
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
        """Look at each surface of the furniture until there is a spot, and an approach to it."""
        arm, any_free = self._hardware.arm_positions, False
        for surface, middle in zip(
            piece.surfaces(), self._home.view_targets(piece.name), strict=True
        ):
            yield from look_at(self._hardware, middle)
            view = View(self._around.scan(), self._hardware.base_pose)
            spot = partial(self._chooser.spot, held, piece, surface, view, arm)
            chosen, is_free = yield from self._planned(spot)
            any_free = any_free or is_free
            if chosen:
                return chosen
        clause = "I cannot reach a free spot on" if any_free else "I see no free spot on"
        raise CannotError(f"{clause} the {piece.name}")

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
        """Look at the spot, and check that the thing stands there."""
        yield from look_at(self._hardware, spot.position)
        height = spot.position[2]
        board = min(piece.surfaces(), key=lambda surface: abs(surface.center[2] - height))
        fault = stands(model, spot, over(piece, self._around.scan()), board.clearance)
        if fault:
            raise LostError(f"the {model.name} {fault} on the {piece.name}")

    # --- helpers ---

    def _planned(self, work: Callable[[], T]) -> Generator[None, None, T]:
        """Have the thinker plan something, with the held thing in the hand."""
        held = self.hand.held

        def plan() -> T:
            if held is None:
                self._planning.carry((), None)
            else:
                self._planning.carry(held.model.shapes, HandPose(held.position, held.rotation))
            return work()

        return (yield from self._thinker.compute(plan))

    def _way_up(self, base: Floats, arm: Floats) -> list[Floats] | None:
        """Joints that raise the hand, as far as there is room; None if it cannot go up."""
        self._planning.forget_target()  # which is in the hand now
        hand = self._planning.hand(base, arm)
        for rise in RISES_M:
            up = self._planning.line(base, arm, hand.shifted(-rise * DOWN))
            if up and self._planning.is_last_part_free(base, up[1:]):
                return up[1:]
        return None

    def _reach(self, approach: Approach, otherwise: str) -> Generator[None, None, Reach]:
        """Plan the reach of an approach, from where the robot stands now.

        Raises:
            CannotError: with the message `otherwise`, if there is no way.
        """
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
        """Whether a grasp like this one has missed the thing."""
        return any(
            name == model.name and (rotation.inv() * grasp.hand.rotation).magnitude() < _ALIKE
            for name, rotation in self._missed
        )
