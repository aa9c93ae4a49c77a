"""What a robot over the wire does for each goal: by its own actions, as its profile names them."""

import asyncio
import math
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Protocol

from executive.errors import InputError
from executive.geometry import Floats
from executive.guards import in_words
from executive.ros.acting import Acting
from executive.ros.actions import Actions
from executive.ros.arm import Arm, Hands, Planar
from executive.ros.link import GoalEnd, Link, LinkError, NoLinkError
from executive.ros.looking import Looking
from executive.ros.losses import Losses
from executive.ros.messages import (
    UPRIGHT,
    planar_pose,
    point_cloud,
    point_stamped,
    pose_stamped,
)
from executive.ros.profile import Profile
from executive.ros.senses import Senses
from executive.ros.stopping import PARTS, Brake
from executive.types.geometry import Pose, Vector3
from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
from executive.types.home import FLOOR, PERSON, Place
from executive.types.perception import Detection
from executive.types.results import Failed, Succeeded

BESIDE_M = 0.5
"""A base that is further from where it was sent has not got there."""
TOLD_S = 3.0
"""So long after a drive it may take until the robot tells where it is."""
BESIDE_RAD = 0.6
"""A point that is further from where the robot faces is not looked at."""
FACING_S = 2.0
TURNS = 2
"""So often it is turned to a point: where it was may have been told too late for the first."""
MOVED_M = 0.3
"""A base that is so far from where it arrived is somewhere else."""
TELLING_S = 1.0
"""So long after a loss of the link it may take until the robot tells where it is."""
HANDLING = ("pick", "place", "gripper")
CANNOT_STOP = "I cannot be told to stop, and may go on"
STOPPING_S = 3.0
"""So long a halt waits for a link that was just lost: with it come the means to stop."""


class Places(Protocol):
    """The home, as far as a robot has to know it."""

    def stand(self, place: str) -> Planar:
        """Where to stand to use a place: x and y in `map` (metres), yaw (radians)."""
        ...

    def view_targets(self, place: str) -> tuple[Vector3, ...]:
        """Points of `map` to look at."""
        ...

    def places(self) -> tuple[Place, ...]:
        """The furniture, with its rooms."""
        ...


@dataclass(frozen=True)
class Remote:
    """A robot at the other end of a link: what it has, what it tells, and what stops it."""

    link: Link
    profile: Profile
    senses: Senses
    brake: Brake
    losses: Losses


class Deeds:
    """Belongs to the thread of the wire; what is no coroutine is for any."""

    def __init__(
        self, remote: Remote, places: Places, hands: Hands, see: Callable[[], Awaitable[Floats]]
    ) -> None:
        """Be where the robot is, and at nothing.

        `hands` is for a robot that has motions, but no skills, and `see` tells which points (n, 3)
        of `map` the camera sees.
        """
        self._link = remote.link
        self._profile = profile = remote.profile
        self._senses = senses = remote.senses
        self._brake = remote.brake
        self._losses = remote.losses
        self._places = places
        self._see = see
        self._actions = Actions(remote.link, profile)
        self._looking = Looking(profile, senses, places.view_targets)
        self._arm = Arm(profile, senses, hands, self._act, self._go) if profile.arm else None
        self._at: str | None = None
        self._arrived: tuple[Pose | None, int] = None, 0
        """Where the base was when it got there, and how often the link had been lost by then."""
        self.acting = Acting(senses)
        """Runs while an action pursues a goal."""

    @property
    def holding(self) -> bool | None:
        """Whether something is in the hand; None if the robot cannot tell."""
        if self._profile.hand is None and self._arm is not None:
            return self._arm.holds
        return self._senses.holding

    def views(self, place: str) -> int:
        """How many looks it takes to see all of a place."""
        return self._looking.views(place)

    async def do(self, goal: Goal) -> Succeeded | Failed:
        """Pursue a goal to its end, whatever is raised on the way."""
        try:
            return await self._done(goal)
        except LinkError as error:
            self._at = None
            return Failed(in_words(error), unreachable=isinstance(error, NoLinkError))
        except Exception as error:
            return Failed(f"something is wrong with what my robot says: {in_words(error)}")

    async def _done(self, goal: Goal) -> Succeeded | Failed:
        match goal:
            case DriveTo(place):
                had = self._senses.holding
                return await self._losses.outlived(lambda: self._drive(place, had))
            case LookAt(place, view, point):
                return await self._losses.outlived(lambda: self._look(place, view, point))
            case Pick(detection):
                return await self._losses.outlived(lambda: self._pick(detection), again=False)
            case PutDown(place):
                return await self._losses.outlived(lambda: self._put_down(place), again=False)
            case Halt():
                return await self._halt()

    async def _act(self, section: str, values: Mapping[str, Any]) -> GoalEnd:
        """Have an action of the robot's pursue a goal."""
        self.acting.run()
        end = await self._actions.do(section, values)
        self.acting.pause()
        if section in HANDLING or not end.succeeded:
            await self._senses.feel_hand_anew()
        return end

    async def _halt(self) -> Succeeded | Failed:
        if self._link.loss:
            try:
                await self._link.ready(0.0 if self._losses.is_for_good else STOPPING_S)
            except LinkError as error:
                return Failed(f"{CANNOT_STOP}: {in_words(error)}")
        failures, unrest = await self._brake.stop()
        if failures and self._link.loss:
            return Failed(f"{CANNOT_STOP}: {self._link.loss}")
        unstopped = [s for s in failures if s in self._actions.used]
        if unstopped:
            section = unstopped[0]
            return Failed(f"I cannot stop my {PARTS[section]}: {failures[section]}")
        self._actions.used.clear()
        return Failed(f"I cannot come to rest: {unrest}") if unrest else Succeeded()

    # --- driving ---

    async def _drive(self, place: str, had: bool | None) -> Succeeded | Failed:
        """Drive to a place; `had` is whether something was in the hand when that was asked for."""
        if why := self._forbidden(place):
            return Failed(why)
        stand = self._stand(place)
        if stand is None:
            return Failed(f"there is no {place} in this home")
        self._at = None
        if self._arm is not None and (why := await self._arm.fold()):
            return Failed(f"I cannot fold my arm: {why}")
        pose = planar_pose(*stand, self._profile.frames.map)
        for leg in await self._actions.legs(pose):
            end = await self._act("drive", {"pose": leg, "place": place})
            lost = bool(had) and self._senses.holding is False
            if not end.succeeded:
                return self._actions.failure(end, f"I did not get to the {place}", lost)
            if lost:
                return Failed(f"what I held fell on the way to the {place}", lost)
        if (apart := await self._apart(stand)) > BESIDE_M:
            there = f"but I am {apart:.1f} m away from there"
            return Failed(f"my drive says that I am at the {place}, {there}")
        self._at, self._arrived = place, (self._senses.base, self._link.losses)
        return Succeeded()

    async def _apart(self, stand: Planar) -> float:
        """How far the base is from where it was sent (metres); 0 if nobody tells.

        What tells so may come later than the end of the drive.
        """
        latest = asyncio.get_running_loop().time() + TOLD_S
        while (base := self._senses.base) is not None:
            apart = math.dist(base.position[:2], stand[:2])
            if apart <= BESIDE_M or asyncio.get_running_loop().time() > latest:
                return apart
            await asyncio.sleep(0.02)
        return 0.0

    async def _go(self, pose: Planar) -> str:
        """Drive there, near where the robot is; why that failed, or nothing."""
        where = planar_pose(*pose, self._profile.frames.map)
        end = await self._act("drive", {"pose": where, "place": self._at or ""})
        return "" if end.succeeded else self._actions.failure(end, "I cannot drive there").reason

    async def _is_at(self, place: str) -> bool:
        """Whether it is where it last got to; without a link nobody knew whether it was moved."""
        then, losses = self._arrived
        if self._at != place or losses == self._link.losses:
            return self._at == place
        now = await self._senses.base_anew(TELLING_S)
        if then is not None and (now is None or math.dist(now.position, then.position) > MOVED_M):
            self._at = None
        else:
            self._arrived = then, self._link.losses
        return self._at == place

    def _stand(self, place: str) -> Planar | None:
        try:
            return self._places.stand(place)
        except InputError:
            return None

    def _forbidden(self, place: str) -> str:
        """Why the robot may not drive there now, as a clause; empty if it may."""
        limits = self._profile.limits
        room = next((one.room for one in self._places.places() if one.name == place), None)
        if limits.rooms is not None and room is not None and room not in limits.rooms:
            return f"I may not go into the {room}"
        if limits.hours is not None:
            begin, end = limits.hours
            now = datetime.now().strftime("%H:%M")
            within = begin <= now < end if begin <= end else now >= begin or now < end
            if not within:
                return f"I may only drive from {begin} to {end}"
        return ""

    # --- looking ---

    async def _look(self, place: str, view: int, point: Vector3 | None) -> Succeeded | Failed:
        if place != FLOOR and not await self._is_at(place):
            return Failed(f"I am not at the {place}")
        if not 0 <= view < self.views(place):
            return Failed(f"there are only {self.views(place)} views of the {place}")
        target = point or self._looking.target(place, view)
        look = self._profile.look
        for _ in range(TURNS if look is not None else 1):
            if look is not None:
                end = await self._act("look", self._looking.goal(place, target))
                if not end.succeeded:
                    return self._actions.failure(end, f"I cannot look at the {place}")
                if look.type.endswith("/PointHead"):
                    return Succeeded()
            if await self._faces(target):
                return Succeeded()
        return Failed(f"I cannot turn to look at the {place}")

    async def _faces(self, target: Vector3) -> bool:
        """Whether the robot faces a point of `map`, as far as its frames tell.

        They may come a little later than the end of the goal that turned it.
        """
        latest = asyncio.get_running_loop().time() + FACING_S
        while self._looking.away(target) > BESIDE_RAD:
            if asyncio.get_running_loop().time() > latest:
                return False
            await asyncio.sleep(0.02)
        return True

    # --- handling ---

    async def _pick(self, detection: Detection) -> Succeeded | Failed:
        if self._arm is not None:
            return await self._arm.pick(detection, self._at)
        if self._profile.pick is None:
            return Failed("I have no arm")
        within = self._profile.frames.map
        middle = detection.position
        if middle is None and self._profile.camera.in_map:
            return Failed(f"I do not see where the {detection.label} is")
        point = middle or (0.0, 0.0, 0.0)
        values: dict[str, Any] = {
            "label": detection.label,
            "points": point_cloud(detection.points, within),
            "confidence": detection.confidence,
            "cut_off": detection.cut_off,
            "point": point_stamped(point, within),
            "pose": pose_stamped(point, UPRIGHT, within),
            "place": self._at or "",
        }
        end = await self._act("pick", values)
        if end.succeeded:
            return Succeeded()
        return self._actions.failure(end, f"I could not pick up the {detection.label}")

    async def _put_down(self, place: str) -> Succeeded | Failed:
        if not self._profile.has_arm:
            return Failed("I have no arm")
        if not await self._is_at(place):
            return Failed(f"I am not at the {place}")
        if place == PERSON:
            return Failed("I can only put things down on furniture")
        if self._arm is not None:
            return await self._set_down(self._arm, place)
        within = self._profile.frames.map
        point = self._places.view_targets(place)[0]
        values: dict[str, Any] = {
            "place": place,
            "point": point_stamped(point, within),
            "pose": pose_stamped(point, UPRIGHT, within),
        }
        end = await self._act("place", values)
        if end.succeeded:
            return Succeeded()
        return self._actions.failure(end, f"I could not put it down on the {place}")

    async def _set_down(self, arm: Arm, place: str) -> Succeeded | Failed:
        """By motions, among what is seen there now."""
        looked = await self._look(place, 0, None)
        if isinstance(looked, Failed):
            return looked
        seen = await self._see()
        if not len(seen):
            return Failed(f"my camera shows nothing of the {place}")
        return await arm.put_down(place, seen)
