"""The instant world: a simulated robot without physics, for tests and campaigns.

It keeps which object is on which furniture, and actions take nominal times. The robot drives in
straight lines, always sees what is there, and never drops an object without an injected fault.
"""

import heapq
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count

import numpy as np

from executive.events import Inbox
from executive.geometry import heading
from executive.interfaces.runtime import Recorder
from executive.perception.tags import spot, spots, tag, whole
from executive.records import Transform, Transforms
from executive.types.geometry import Pose
from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
from executive.types.home import DELIVERY, FLOOR, PERSON
from executive.types.perception import Detection, Frame, Intrinsics
from executive.types.results import Failed, Result, Succeeded
from sim.goals import GoTo
from sim.home.arrangement import Spot
from sim.home.furniture import PlanarPose
from sim.home.home import Home
from sim.objects.objects import why_not_taken

SPEED_M_S = 0.8
"""Nominal driving speed."""
LOOK_S, PICK_S, PUT_DOWN_S, REST_S = 0.5, 8.0, 6.0, 0.5
"""Nominal durations."""
EYE_HEIGHT_M = 1.35
"""Height of the camera above the floor."""

Fault = Callable[[Goal], str | None]
"""Returns why a goal fails, or None if it does not."""


def _no_fault(goal: Goal) -> None:
    return None


@dataclass(order=True)
class _Due:
    time: float
    number: int
    request: int = field(compare=False)
    finish: Callable[[], Result] = field(compare=False)


@dataclass(frozen=True)
class Drive:
    """A drive in a straight line; poses are x and y (m) and yaw (rad) in `map`."""

    began: float
    start: tuple[float, float, float]
    goal: tuple[float, float, float]
    seconds: float

    def at(self, time: float) -> tuple[float, float, float]:
        """The robot's pose at a time (s); it turns at once when the drive begins."""
        part = min(1.0, (time - self.began) / self.seconds) if self.seconds else 1.0
        x, y, _ = (a + part * (b - a) for a, b in zip(self.start, self.goal, strict=True))
        return x, y, self.goal[2]


def knows(home: Home, place: str) -> bool:
    """Whether the robot can be sent to a place of this name."""
    return place in (PERSON, DELIVERY) or any(piece.name == place for piece in home.furniture)


def straight_s(home: Home, start: str, place: str, speed_m_s: float = SPEED_M_S) -> float:
    """The time of a straight drive (s); infinite if one of the places is not in this home."""
    if not (knows(home, start) and knows(home, place)):
        return math.inf
    ends = (home.stand(name)[:2] for name in (start, place))
    return math.dist(*ends) / speed_m_s


class FakeWorld:
    """The state of the instant world, and the requests that will end. Implements World."""

    def __init__(
        self,
        home: Home,
        inbox: Inbox,
        recorder: Recorder,
        fault: Fault = _no_fault,
        spots: int | None = None,
    ) -> None:
        """Begin with everything where the home has it.

        Args:
            home: rooms, furniture, and where objects are.
            inbox: receives the results of the robot's goals.
            recorder: receives movements.
            fault: makes chosen goals fail.
            spots: how many objects fit on a piece of furniture; None: any number.
        """
        self.home = home
        self.inbox = inbox
        self.recorder = recorder
        self.fault = fault
        self.spots = spots
        self.things: dict[str, str] = dict(home.placement)
        self.held: str | None = None
        self.at: str | None = PERSON
        self.pose = home.robot_start
        self.looking_at: str | None = None
        self.drive: Drive | None = None
        """The current drive, if any."""
        self._time = 0.0
        self._numbers = count()
        self._agenda: list[_Due] = []

    @property
    def busy(self) -> bool:
        """Whether any request is open."""
        return bool(self._agenda)

    def advance(self, at_most: float) -> float:
        """Let time pass until the next request is due, at most `at_most` seconds.

        If one is due now, end it; no time passes then.

        Returns:
            The time that has passed (s).
        """
        until_due = self._agenda[0].time - self._time if self._agenda else math.inf
        if until_due > 0:
            passed = min(at_most, until_due)
            self._time += passed
            return passed
        due = heapq.heappop(self._agenda)
        self.inbox.end(due.request, due.finish())
        return 0.0

    def close(self) -> None:
        """Do nothing: there is nothing to close."""

    def resting_place(self, name: str) -> str | None:
        """The furniture that an object is on, by ground truth; None if held or not here."""
        return self.things.get(name)

    def left(self) -> dict[str, Spot]:
        """The spots of all objects that are on furniture."""
        pieces = {piece.name for piece in (*self.home.furniture, self.home.delivery)}
        on_furniture = ((name, place) for name, place in self.things.items() if place in pieces)
        return {name: Spot(furniture=place) for name, place in on_furniture}

    def put(self, name: str, furniture: str) -> bool:
        """Put an object on other furniture, as a person would; whether that was possible."""
        there = list(self.things.values()).count(furniture)
        if name not in self.things or (self.spots is not None and there >= self.spots):
            return False
        self.things[name] = furniture
        return True

    def describe(self) -> None:
        """Record the robot's pose."""
        x, y, yaw = self.pose
        orientation = heading(yaw)
        base = Transform("map", "base_link", Pose((x, y, 0.0), orientation))
        self.recorder.record(Transforms((base,)))

    @property
    def time(self) -> float:
        """The time since the world began (s)."""
        return self._time

    def brake(self) -> None:
        """Stop the current drive, if any, where it is now."""
        if self.drive:
            self.pose, self.drive = self.drive.at(self._time), None
            self.describe()

    def schedule(self, delay: float, finish: Callable[[], Result]) -> int:
        """Open a request that ends after `delay` seconds with the result of `finish`."""
        request = self.inbox.open()
        heapq.heappush(self._agenda, _Due(self._time + delay, next(self._numbers), request, finish))
        return request

    def forget(self, request: int) -> bool:
        """Remove a request from the agenda; return whether it was there."""
        before = len(self._agenda)
        self._agenda = [due for due in self._agenda if due.request != request]
        heapq.heapify(self._agenda)
        return len(self._agenda) < before


class FakeRobot:
    """Implements `Robot` in the instant world."""

    def __init__(self, world: FakeWorld) -> None:
        """Begin at the world's start pose."""
        self._world = world
        self._request: int | None = None

    @property
    def holding(self) -> bool:
        """Whether it holds an object."""
        return self._world.held is not None

    def views(self, place: str) -> int:
        """Always 1: one look sees all of a place."""
        return 1

    def seconds(self, start: str, place: str) -> float:
        """The time of a straight drive (s); infinite if one of the places is not in this home."""
        return straight_s(self._world.home, start, place)

    def start(self, goal: Goal | GoTo) -> int:
        """Pursue a goal for its nominal time."""
        if self._request is not None and self._world.forget(self._request):
            self._world.brake()
            self._world.inbox.end(self._request, Failed("replaced by another goal"))
        delay, effect = self._plan(goal)

        def finish() -> Result:
            reason = None if isinstance(goal, GoTo) else self._world.fault(goal)
            return Failed(reason) if reason else effect()

        self._request = self._world.schedule(delay, finish)
        return self._request

    def cancel(self, request: int) -> None:
        """Cancel a request; the robot stops where it is."""
        if self._world.forget(request):
            self._world.brake()
        self._world.inbox.drop(request)

    def _plan(self, goal: Goal | GoTo) -> tuple[float, Callable[[], Result]]:
        match goal:
            case GoTo(x, y, yaw):
                return self._go((x, y, yaw), None)
            case DriveTo(place):
                return self._drive(place)
            case LookAt(place, view):
                return LOOK_S, lambda: self._look(place, view)
            case Pick(detection):
                return PICK_S, lambda: self._pick(detection.label)
            case PutDown(place):
                return PUT_DOWN_S, lambda: self._put_down(place)
            case Halt():
                return REST_S, Succeeded

    def _knows(self, place: str) -> bool:
        return knows(self._world.home, place)

    def _drive(self, place: str) -> tuple[float, Callable[[], Result]]:
        world = self._world
        if not self._knows(place):
            return 0.0, lambda: Failed(f"there is no {place} in this home")
        return self._go(world.home.stand(place), place)

    def _go(self, pose: PlanarPose, place: str | None) -> tuple[float, Callable[[], Result]]:
        world = self._world
        distance = math.dist(pose[:2], world.pose[:2])
        world.at = world.looking_at = None
        world.drive = Drive(world.time, world.pose, pose, distance / SPEED_M_S)

        def arrive() -> Result:
            world.at, world.pose, world.drive = place, pose, None
            world.describe()
            return Succeeded()

        return distance / SPEED_M_S, arrive

    def _look(self, place: str, view: int) -> Result:
        if not 0 <= view < self.views(place):
            return Failed(f"there is only one view of the {place}")
        if place not in (self._world.at, FLOOR):
            return Failed(f"I am not at the {place}")
        self._world.looking_at = place
        return Succeeded()

    def _pick(self, name: str) -> Result:
        world = self._world
        if world.held:
            return Failed(f"my hand already holds the {world.held}")
        if world.things.get(name) not in (world.at, FLOOR):
            return Failed(f"the {name} is out of reach")
        if why := why_not_taken(world.home.models()[name]):
            return Failed(f"I cannot grasp the {name} as it lies: {why}")
        del world.things[name]
        world.held = name
        return Succeeded()

    def _put_down(self, place: str) -> Result:
        world = self._world
        if world.held is None:
            return Failed("my hand is empty")
        if world.at != place:
            return Failed(f"I am not at the {place}")
        if world.spots is not None and list(world.things.values()).count(place) >= world.spots:
            return Failed(f"there is no free spot on the {place}")
        world.things[world.held], world.held = place, None
        return Succeeded()


class FakeCamera:
    """Implements Camera: grey pictures with a tag for each object in view."""

    intrinsics = Intrinsics(width=160, height=120, fx=125.0, fy=125.0, cx=79.5, cy=59.5)

    def __init__(self, world: FakeWorld) -> None:
        """Take pictures of this world."""
        self._world = world
        self._numbers = count()

    def capture(self) -> Frame:
        """Take a picture now."""
        size = (self.intrinsics.height, self.intrinsics.width)
        color = np.full((*size, 3), 120, dtype=np.uint8)
        for name, box in zip(in_view(self._world), spots(size[1], size[0]), strict=False):
            rows = slice(box.top, box.top + box.height)
            color[rows, box.left : box.left + box.width] = tag(name)
        x, y, _ = self._world.pose
        looking_down = Pose((x, y, EYE_HEIGHT_M), (1.0, 0.0, 0.0, 0.0))
        depth = np.full(size, 1.0, dtype=np.float32)
        return Frame(next(self._numbers), color, depth, self.intrinsics, looking_down)


class FakeDetector:
    """Implements Detector with the world's ground truth: stands in for a real one."""

    def __init__(self, world: FakeWorld) -> None:
        """Detect the objects of this world."""
        self._world = world

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All objects on the furniture that the robot looks at, whatever the picture shows."""
        return tuple(
            Detection(name, 1.0, spot(index, FakeCamera.intrinsics.width), whole())
            for index, name in enumerate(in_view(self._world))
        )


def in_view(world: FakeWorld) -> tuple[str, ...]:
    """Names of the objects on the furniture that the robot looks at, in the home's order."""
    if world.looking_at is None:
        return ()
    return tuple(name for name, place in world.things.items() if place == world.looking_at)
