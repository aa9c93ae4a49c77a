"""The simulated robot: turns goals into skills, and runs one skill at a time."""

import logging
import math
from collections.abc import Sequence

from executive.errors import InputError
from executive.events import Inbox
from executive.text import printable
from executive.types.geometry import Vector3
from executive.types.goals import DriveTo, Halt, LookAt, Pick, PutDown
from executive.types.home import FLOOR, PERSON
from executive.types.results import Failed, Succeeded
from sim.body.arm import hold
from sim.body.base import CARRYING, FREE, brake
from sim.body.hardware import Hardware
from sim.body.head import hold_head, look_at
from sim.body.skill import CannotError, Skill, Thinker, pause, wait_until
from sim.goals import AnyGoal, Face, GoTo, Grip, MoveHand, MoveJoints
from sim.home.furniture import PlanarPose
from sim.home.home import FLOOR_VIEWS, Home
from sim.manipulation.hand import LostError
from sim.manipulation.manipulator import Manipulator
from sim.manipulation.motions import Motions
from sim.navigation.durations import Durations
from sim.navigation.grid import Unreachable
from sim.navigation.navigator import Navigator

log = logging.getLogger(__name__)

FLOOR_PANS = (0.0, 1.0, -1.0, 2.0, -2.0)
"""Bearings at which the robot looks at the floor, counted from its own yaw to the left (rad)."""
FLOOR_AHEAD_M = 0.9
"""How far from its middle it looks at the floor."""
REST_S = 1.5
"""How long arm, fingers and head may move on after the base has stopped."""
ROLLING_S = 1.5
"""How long the robot waits for a thing that fell to come to rest, before it reports the loss."""


class SimulatedRobot:
    """Implements `Robot` with the skills of this package.

    The world calls `feel` and `control` in every control period.
    """

    def __init__(
        self,
        hardware: Hardware,
        navigator: Navigator,
        durations: Durations,
        manipulator: Manipulator,
        motions: Motions,
        home: Home,
        inbox: Inbox,
        thinker: Thinker,
    ) -> None:
        """Connect the parts; the robot is idle, and not at any place."""
        self._hardware = hardware
        self._navigator = navigator
        self._durations = durations
        self._manipulator = manipulator
        self._motions = motions
        self._home = home
        self._inbox = inbox
        self._thinker = thinker
        self._skill: Skill | None = None
        self._request: int | None = None
        self._at: str | None = None

    # --- Robot ---

    @property
    def holding(self) -> bool:
        """Whether both fingers touch a thing now."""
        return self._manipulator.hand.holding

    def views(self, place: str) -> int:
        """How many head poses it takes to see all of a place."""
        return FLOOR_VIEWS if place == FLOOR else len(self._home.view_targets(place))

    def seconds(self, start: str, place: str) -> float:
        """How long the drive takes with an empty hand (s), by the map; infinite if it cannot be."""
        return self._durations.seconds(start, place)

    def start(self, goal: AnyGoal) -> int:
        """Pursue a goal; it ends as Succeeded, or as Failed with a reason."""
        if self._request is not None:
            self._inbox.end(self._request, Failed("replaced by another goal"))
            hold(self._hardware)
        self._request = self._inbox.open()
        self._pursue(self._skill_for(goal))
        return self._request

    def cancel(self, request: int) -> None:
        """Give up the goal and brake to rest; its end is not delivered."""
        self._inbox.drop(request)
        if request == self._request:
            self._request = None
            self._pursue(self._rest())

    def close(self) -> None:
        """Give up the skill that is under way, and what is being computed for it."""
        if self._skill is not None:
            self._skill.close()
        self._thinker.close()

    # --- for the world ---

    @property
    def handling(self) -> bool:
        """Whether the arm is out or something is in the hand."""
        return self._manipulator.handling

    @property
    def base_pose(self) -> tuple[float, float, float]:
        """Where `base_link` is in `map`: x and y (metres), yaw (radians)."""
        x, y, yaw = (float(value) for value in self._hardware.base_pose)
        return x, y, yaw

    @property
    def active(self) -> bool:
        """Whether a skill is under way."""
        return self._skill is not None

    def moving(self) -> tuple[str, ...]:
        """Which of base, arm, fingers and head move."""
        return self._hardware.moving()

    @property
    def computing(self) -> bool:
        """Whether the skill waits for a computation; no time may pass meanwhile."""
        return self._thinker.busy

    def feel(self) -> None:
        """Feel what is in the hand; called in every control period, also of an idle robot."""
        self._manipulator.hand.sense()

    def control(self) -> None:
        """Let the skill command the motors for one control period; report its end."""
        if self._skill is None:
            return
        try:
            next(self._skill)
        except StopIteration:
            self._end(Succeeded())
        except CannotError as failure:
            self._end(Failed(str(failure), lost=isinstance(failure, LostError)))
        except Exception as error:
            log.debug("a skill raised", exc_info=error)
            why = printable(str(error) or type(error).__name__)
            self._end(Failed(f"something is wrong with my control: {why}"))
            self._skill = self._rest()

    def _pursue(self, skill: Skill) -> None:
        if self._skill is not None:
            self._skill.close()
        self._skill = skill

    def _end(self, result: Succeeded | Failed) -> None:
        self._skill = None
        if self._request is not None:
            self._inbox.end(self._request, result)
            self._request = None

    # --- skills ---

    def _skill_for(self, goal: AnyGoal) -> Skill:
        match goal:
            case DriveTo(place):
                return self._drive(place)
            case GoTo(x, y, yaw):
                return self._go((x, y, yaw), "", "place")
            case Face(point):
                return look_at(self._hardware, point)
            case LookAt(place, view, point):
                return self._look(place, view, point)
            case Pick(detection):
                return self._manipulator.pick(detection)
            case PutDown(place):
                return self._put_down(place)
            case Halt():
                return self._rest()
            case MoveHand():
                return self._motions.move_hand(goal)
            case MoveJoints():
                return self._motions.move_joints(goal)
            case Grip():
                return self._motions.grip(goal)

    def _drive(self, place: str) -> Skill:
        self._check_exists(place)
        yield from self._go(self._home.stand(place), place, place)

    def _go(self, pose: PlanarPose, place: str, called: str) -> Skill:
        """Drive to a pose.

        Args:
            pose: x, y (metres) and yaw (radians) in `map`.
            place: the robot is at this place when it arrives; empty: at none.
            called: what reasons call the goal.
        """
        yield from brake(self._hardware)
        yield from self._manipulator.stow()
        self._at = None
        limits = CARRYING if self._manipulator.hand.grips else FREE
        try:
            for _ in self._navigator.go(pose, limits):
                self._manipulator.hand.feel()
                yield
        except LostError:
            yield from brake(self._hardware)
            yield from pause(ROLLING_S)
            raise
        except Unreachable as reason:
            raise CannotError(reason.clause(called)) from reason
        self._at = place or None

    def _look(self, place: str, view: int, point: Vector3 | None) -> Skill:
        targets = self._targets(place)
        if not 0 <= view < len(targets):
            raise CannotError(f"there are only {len(targets)} views of the {place}")
        yield from look_at(self._hardware, point or targets[view])

    def _targets(self, place: str) -> Sequence[Vector3]:
        """Points of `map` to look at, to see all of a place."""
        if place != FLOOR:
            self._check_here(place)
            return self._home.view_targets(place)
        x, y, yaw = self.base_pose
        return [
            (x + FLOOR_AHEAD_M * math.cos(yaw + pan), y + FLOOR_AHEAD_M * math.sin(yaw + pan), 0.0)
            for pan in FLOOR_PANS[:FLOOR_VIEWS]
        ]

    def _put_down(self, place: str) -> Skill:
        self._check_here(place)
        if place == PERSON:
            raise CannotError("I can only put things down on furniture")
        yield from self._manipulator.put_down(place)

    def _rest(self) -> Skill:
        """Come to rest with base, arm, fingers and head; the hand keeps what it holds.

        Raises:
            CannotError: if a part goes on moving.
        """
        hold(self._hardware)
        hold_head(self._hardware)
        self._manipulator.hand.hold()
        yield from brake(self._hardware)
        at_rest = wait_until(lambda: not self._restless_parts(), REST_S)
        if not (yield from at_rest):
            raise CannotError(_moves(self._restless_parts()))
        self._manipulator.hand.settle()

    def _restless_parts(self) -> tuple[str, ...]:
        """The parts that move, and the fingers as long as it is not clear what they hold."""
        moving = self._hardware.moving()
        wavers = self._manipulator.hand.wavers and "fingers" not in moving
        return (*moving, "fingers") if wavers else moving

    # --- helpers ---

    def _check_exists(self, place: str) -> None:
        if place == PERSON:
            return
        try:
            self._home.furniture_named(place)
        except InputError:
            raise CannotError(f"there is no {place} in this home") from None

    def _check_here(self, place: str) -> None:
        self._check_exists(place)
        if self._at != place:
            raise CannotError(f"I am not at the {place}")


def _moves(parts: Sequence[str]) -> str:
    verb = "moves" if len(parts) == 1 else "move"
    return f"I cannot come to rest: my {' and my '.join(parts)} {verb}"
