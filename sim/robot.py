"""The simulated robot: turns goals into skills and runs one at a time."""

from executive.errors import InputError
from executive.events import Inbox
from executive.interfaces import Recorder
from executive.records import Path
from executive.types import DriveTo, Failed, Goal, Halt, LookAt, Pick, PutDown, Succeeded, Vector3
from sim.arm import hold
from sim.driving import brake, drive
from sim.hardware import Hardware
from sim.home import PERSON, Home
from sim.looking import look_at
from sim.manipulation import Manipulator
from sim.navigation import OccupancyGrid, Unreachable, plan
from sim.skill import CannotError, Skill


class SimulatedRobot:
    """Implements Robot with the skills of this package; the world calls `control`."""

    def __init__(
        self,
        hardware: Hardware,
        manipulator: Manipulator,
        home: Home,
        inbox: Inbox,
        recorder: Recorder,
    ) -> None:
        """Stand idle."""
        self._hardware = hardware
        self._manipulator = manipulator
        self._home = home
        self._grid = OccupancyGrid.from_home(home)
        self._inbox = inbox
        self._recorder = recorder
        self._skill: Skill | None = None
        self._request: int | None = None
        self._at: str | None = None

    # --- Robot ---

    @property
    def holding(self) -> bool:
        """Whether both fingers touch a thing, now."""
        return self._manipulator.holding

    def views(self, place: str) -> int:
        """How many head poses it takes to see all of a place."""
        return len(self._home.view_targets(place))

    def start(self, goal: Goal) -> int:
        """Pursue a goal; ends Succeeded, or Failed with a reason."""
        if self._request is not None:
            self._inbox.end(self._request, Failed("replaced by another goal"))
            hold(self._hardware)
        self._request = self._inbox.open()
        self._skill = self._skill_for(goal)
        return self._request

    def cancel(self, request: int) -> None:
        """Give up the goal and brake to rest; its end is not delivered."""
        self._inbox.drop(request)
        if request == self._request:
            self._request = None
            self._skill = self._rest()

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

    def control(self) -> None:
        """Let the skill command the motors for the next control period."""
        if self._skill is None:
            return
        try:
            next(self._skill)
        except StopIteration:
            self._end(Succeeded())
        except CannotError as failure:
            self._end(Failed(str(failure)))

    def _end(self, result: Succeeded | Failed) -> None:
        self._skill = None
        if self._request is not None:
            self._inbox.end(self._request, result)
            self._request = None

    # --- skills ---

    def _skill_for(self, goal: Goal) -> Skill:
        match goal:
            case DriveTo(place):
                return self._drive(place)
            case LookAt(place, view, point):
                return self._look(place, view, point)
            case Pick(detection):
                return self._manipulator.pick(detection)
            case PutDown(place):
                return self._put_down(place)
            case Halt():
                return self._rest()

    def _drive(self, place: str) -> Skill:
        self._check(place)
        yield from brake(self._hardware)
        yield from self._manipulator.stow()
        self._at = None
        x, y, yaw = self._home.stand(place)
        here = self._hardware.base_pose
        try:
            way = plan(self._grid, (float(here[0]), float(here[1])), (x, y))
        except Unreachable as reason:
            raise CannotError(str(reason)) from reason
        self._recorder.record(Path(tuple((px, py, 0.0) for px, py in way)))
        try:
            yield from drive(self._hardware, way, yaw)
        except CannotError:
            raise CannotError(f"the way to the {place} is blocked") from None
        self._at = place

    def _look(self, place: str, view: int, point: Vector3 | None) -> Skill:
        self._check_here(place)
        targets = self._home.view_targets(place)
        if not 0 <= view < len(targets):
            raise CannotError(f"there are only {len(targets)} views of the {place}")
        yield from look_at(self._hardware, point or targets[view])

    def _put_down(self, place: str) -> Skill:
        self._check_here(place)
        if place == PERSON:
            raise CannotError("I can only put things down on furniture")
        yield from self._manipulator.put_down(place)

    def _rest(self) -> Skill:
        hold(self._hardware)
        yield from brake(self._hardware)

    # --- helpers ---

    def _check(self, place: str) -> None:
        if place == PERSON:
            return
        try:
            self._home.furniture_named(place)
        except InputError:
            raise CannotError(f"there is no {place} in this home") from None

    def _check_here(self, place: str) -> None:
        self._check(place)
        if self._at != place:
            raise CannotError(f"I am not at the {place}")
