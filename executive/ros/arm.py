"""Picking up and putting down by a robot that has motions and a gripper, but no skills of its own.

The way to grasp comes from elsewhere (`Hands`): this reaches for it, closes, and carries.
"""

import asyncio
import math
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats, carried_by, pose_from, seen_from
from executive.records import Shape
from executive.ros.link import GoalEnd
from executive.ros.moveit import Load, Obstacle, failure, scene, to_joints, to_pose
from executive.ros.packets import numbers
from executive.ros.profile import ArmAction, GripperAction, Profile
from executive.ros.protocol import GoalStatus, Message
from executive.ros.senses import Senses
from executive.types.geometry import Pose, Vector3
from executive.types.perception import Detection
from executive.types.results import Failed, Succeeded

BACK_M, UP_M = 0.10, 0.10
"""So far before a grasp the straight last part begins; so high a thing is lifted."""
MOST_TRIES = 6
"""So many ways to grasp are reached for."""
MOST_STANCES = 3
"""To so many places to stand it is driven, until it gets to one."""
ABOVE_M = 0.12
"""So far above where it is to stand a thing is brought first."""

Act = Callable[[str, Mapping[str, Any]], Awaitable[GoalEnd]]
"""Has an action of a section pursue a goal."""
Planar = tuple[float, float, float]
"""x and y (metres) and yaw (radians) in `map`."""
Go = Callable[[Planar], Awaitable[str]]
"""Drives to a pose; returns why that failed, or nothing."""


@dataclass(frozen=True, slots=True)
class Hold:
    """A way to hold a thing.

    Attributes:
        hand: the point between the fingers in `map`; z points out of the hand, y to a finger.
        gap: how far the fingers have to be open (metres).
        thing: where the thing is in `map` then.
        box: what the thing fits into, in the thing's frame.
        force: how hard each finger shall press (newtons): light things are held gently.
    """

    hand: Pose
    gap: float
    thing: Pose
    box: Shape
    force: float


class Hands(Protocol):
    """Knows how things are held, where they can stand, and what is around.

    Not called on the wire's thread.
    """

    def grasps(self, detection: Detection, base: Pose) -> Sequence[Hold]:
        """Ways to hold what is seen, the best first; none if there is no model of it."""
        ...

    def spots(self, place: str, label: str, seen: Floats) -> Sequence[Pose]:
        """Where on a place the thing can stand, among the points (n, 3) that are seen."""
        ...

    def stances(
        self, place: str | None, point: Vector3, base: Pose, near_m: float
    ) -> Sequence[Planar]:
        """Where to stand to reach a point on a place, or on the floor (None); the best first."""
        ...

    def obstacles(self, base: Pose) -> Sequence[Obstacle]:
        """What an arm on this base has to keep clear of."""
        ...


class NoHands:
    """Implements `Hands`: nothing is known."""

    def grasps(self, detection: Detection, base: Pose) -> Sequence[Hold]:
        """None."""
        return ()

    def spots(self, place: str, label: str, seen: Floats) -> Sequence[Pose]:
        """None."""
        return ()

    def stances(
        self, place: str | None, point: Vector3, base: Pose, near_m: float
    ) -> Sequence[Planar]:
        """None."""
        return ()

    def obstacles(self, base: Pose) -> Sequence[Obstacle]:
        """None."""
        return ()


class Arm:
    """Belongs to the thread of the wire."""

    def __init__(self, profile: Profile, senses: Senses, hands: Hands, act: Act, go: Go) -> None:
        """The hand is believed to be as the profile's `[hand]` tells, if it does."""
        assert profile.arm is not None
        assert profile.gripper is not None
        self._arm: ArmAction = profile.arm
        self._gripper: GripperAction = profile.gripper
        self._frames = profile.frames
        self._senses = senses
        self._hands = hands
        self._act = act
        self._go = go
        self.holds: bool | None = None
        """By what the gripper said last; None: it was not asked yet."""
        self._held: tuple[str, Hold] | None = None
        self._is_out = False

    async def pick(self, detection: Detection, place: str | None) -> Succeeded | Failed:
        """Take a thing that is seen on a place, or on the floor (None).

        If it is in the hand already, since it could not be lifted or carried, only that is left.
        """
        name = detection.label
        if self._held is not None and self._feels:
            held, hold = self._held
            return await self._carry(name, hold) if held == name else _full(held)
        if not await self._ways(detection):
            return Failed(f"I know no way to grasp the {name}")
        middle = np.median(detection.points.astype(np.float64), axis=0)
        if why := await self._come_near(place, middle):
            return Failed(f"I do not get near the {name}: {why}")
        ways = await self._ways(detection)
        if why := await self._grip(self._gripper.open):
            return Failed(f"my hand does not open: {why}")
        self._held, why = None, "I know no way from here"
        for hold in ways[:MOST_TRIES]:
            why = await self._reach(hold)
            if not why:
                return await self._take(name, hold)
        await self.fold()
        return Failed(f"I cannot reach the {name}: {why}")

    async def _ways(self, detection: Detection) -> list[Hold]:
        """To grasp it from where the robot stands, as far as the hand opens; the best first."""
        if (base := self._senses.base) is None:
            return []
        found = await asyncio.to_thread(self._hands.grasps, detection, base)
        return [hold for hold in found if hold.gap <= self._gripper.opens_m]

    async def _come_near(self, place: str | None, point: Floats) -> str:
        """Drive to where the point is in reach; why that could not be, or nothing."""
        base, near_m = self._senses.base, self._arm.near_m
        if near_m is None or base is None:
            return ""
        x, y, z = (float(one) for one in point)
        stances = self._hands.stances
        found = await asyncio.to_thread(stances, place, (x, y, z), base, near_m)
        why = ""
        if found and (why := await self.fold()):
            return f"I cannot fold my arm: {why}"
        for stance in found[:MOST_STANCES]:
            why = await self._go(stance)
            if not why:
                return ""
        return why

    async def _reach(self, hold: Hold) -> str:
        """Bring the open hand around the thing; why that could not be, or nothing."""
        before = _back(hold.hand)
        if why := await self._move(before):
            return why
        if why := await self._move(hold.hand, straight=True):
            await self._move(before, straight=True)
            return why
        return ""

    async def _take(self, name: str, hold: Hold) -> Succeeded | Failed:
        self._held = name, hold  # from now on: it may be stopped when the fingers have closed
        why = await self._grip(self._gripper.closed, hold.force)
        if why or not self._feels:
            self._held = None
            await self._grip(self._gripper.open)
            await self._move(_back(hold.hand), straight=True)
            await self.fold()
            return Failed(why or f"my hand closed without the {name}")
        return await self._carry(name, hold)

    async def _carry(self, name: str, hold: Hold) -> Succeeded | Failed:
        """Lift what the fingers are around, and fold the arm with it."""
        if why := await self._move(_shifted(hold.hand, (0.0, 0.0, UP_M)), straight=True):
            return Failed(f"I cannot lift the {name}: {why}")
        if why := await self.fold():
            return Failed(f"I cannot carry the {name}: {why}")
        return Succeeded()

    async def put_down(self, place: str, seen: Floats) -> Succeeded | Failed:
        """Put down what is held on a place, of which these points (n, 3) in `map` are seen."""
        if self._held is None:
            return Failed("I do not know how I hold it, it has to be taken out of my hand")
        name, hold = self._held
        if self._has_lost_it:
            return self._fell(name)
        spots = await asyncio.to_thread(self._hands.spots, place, name, seen)
        why = f"there is no room on the {place}"
        if spots and (away := await self._come_near(place, np.array(spots[0].position))):
            return Failed(f"I do not get near the {place}: {away}")
        for spot in spots[:MOST_TRIES]:
            hand = _moved_with(hold, spot)
            above = _shifted(hand, (0.0, 0.0, ABOVE_M))
            why = await self._move(above) or await self._move(hand, straight=True)
            if self._has_lost_it:
                await self.fold()
                return self._fell(name)
            if not why:
                return await self._let_go(hand)
        await self.fold()
        return Failed(why)

    @property
    def _feels(self) -> bool | None:
        """Whether something is in the hand; if nothing else feels it, as the gripper has it."""
        felt = self._senses.holding
        return self.holds if felt is None else felt

    @property
    def _has_lost_it(self) -> bool:
        """Whether what should be in the hand is not, as far as anybody tells."""
        return self._senses.holding is False

    def _fell(self, name: str) -> Failed:
        self._held = None
        return Failed(f"the {name} fell from my hand", lost=True)

    async def _let_go(self, hand: Pose) -> Succeeded | Failed:
        if why := await self._grip(self._gripper.open):
            return Failed(f"my hand does not open: {why}")
        self._held = None
        await self._move(_back(hand), straight=True)
        await self.fold()
        return Succeeded()

    async def fold(self) -> str:
        """Bring the arm to where it carries, if it is elsewhere; why that failed, or nothing.

        The robot does not drive with its arm out, as it may be after a halt.
        """
        if not self._is_out:
            return ""
        arm = self._arm
        why = await self._motion(to_joints(arm.group, arm.carry, arm.speed))
        self._is_out = bool(why)
        return why

    # --- goals ---

    async def _move(self, hand: Pose, straight: bool = False) -> str:
        base = self._senses.base
        if base is None:
            return "nobody tells where I am"
        arm, pose, self._is_out = self._arm, seen_from(base, hand), True
        planner = arm.straight if straight else ""
        return await self._motion(
            to_pose(arm.group, arm.tip, self._frames.base, pose, arm.speed, planner), straight
        )

    def _load(self, touches: bool) -> Load | None:
        """What MoveIt is told of what is in the hand."""
        if self._held is None or touches or not self._gripper.links:
            return None
        if self._has_lost_it:
            return None
        _, hold = self._held
        pose = seen_from(hold.hand, carried_by(hold.thing, hold.box.pose))
        return Load(hold.box.size, pose, self._arm.tip, self._gripper.links)

    async def _motion(self, request: Message, touches: bool = False) -> str:
        """Have MoveIt do it; if what is held touches what it stands on, that has to be allowed."""
        base = self._senses.base
        if base is None:
            return "nobody tells where I am"
        around = await asyncio.to_thread(self._hands.obstacles, base)
        diff = scene(around, base, self._frames.base, self._load(touches))
        end = await self._act("arm", {"request": request, "scene": diff})
        why = failure(end.values)
        return why or ("" if end.succeeded else end.reason or "my arm did not get there")

    async def _grip(self, position: float, force: float = math.inf) -> str:
        """Move the fingers; something between them may stop these. Why it failed, or nothing."""
        gripper = self._gripper
        effort = min(gripper.effort, force) if gripper.newtons else gripper.effort
        values = {"position": position, "effort": effort, "joint": gripper.joint}
        self.holds = None
        end = await self._act("gripper", values)
        stalled, reached = end.values.get("stalled"), end.values.get("reached_goal")
        called_off = end.status == GoalStatus.CANCELED
        if called_off or (not end.succeeded and stalled is not True):
            return end.reason or ("it was called off" if called_off else "it did not get there")
        closing, is_stuck = position == gripper.closed, stalled is True and reached is not True
        if is_stuck and not closing and not self._is_open(end):
            return end.reason or "something keeps it closed"
        self.holds = closing and is_stuck
        return ""

    def _is_open(self, end: GoalEnd) -> bool:
        """Whether the fingers are nearer to open than to closed, as far as their action tells."""
        gripper, state = self._gripper, end.values.get("state")
        told = state.get("position", []) if isinstance(state, dict) else None
        match numbers(told) if told is not None else (end.values.get("position"),):
            case (int() | float() as at, *_):
                return abs(at - gripper.open) < abs(at - gripper.closed)
            case _:
                return end.succeeded


def _full(held: str) -> Failed:
    return Failed(f"my hand already holds the {held}")


def _back(hand: Pose) -> Pose:
    """Where the straight last part to there begins, and the way back from there ends."""
    return _shifted(hand, Rotation.from_quat(hand.orientation).apply((0.0, 0.0, -BACK_M)))


def _shifted(pose: Pose, offset: Floats | Vector3) -> Pose:
    x, y, z = (float(one) for one in np.add(pose.position, offset))
    return Pose((x, y, z), pose.orientation)


def _moved_with(hold: Hold, spot: Pose) -> Pose:
    """Where the hand is when what it holds so is at the spot."""
    thing = Rotation.from_quat(hold.thing.orientation)
    turn = Rotation.from_quat(spot.orientation) * thing.inv()
    offset = np.subtract(hold.hand.position, hold.thing.position)
    return pose_from(
        np.add(spot.position, turn.apply(offset)),
        turn * Rotation.from_quat(hold.hand.orientation),
    )
