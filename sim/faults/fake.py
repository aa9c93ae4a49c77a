"""The robot of the instant world with faults, as far as these make sense without physics."""

from collections.abc import Callable

from executive.types.goals import DriveTo, Goal, Pick, PutDown
from executive.types.home import FLOOR
from executive.types.results import Failed, Result
from sim.fake import FakeRobot, FakeWorld
from sim.faults.injector import FaultInjector
from sim.faults.orders import Blocked, Drop, Moved, Slip, Stuck
from sim.goals import GoTo
from sim.home.floorplan import doors_between


class FaultyFakeRobot(FakeRobot):
    """Implements Robot in the instant world; faults strike when a goal ends."""

    def __init__(self, world: FakeWorld, injector: FaultInjector) -> None:
        """Begin at the world's start pose; `injector` has the faults."""
        super().__init__(world)
        self._injector = injector

    def _plan(self, goal: Goal | GoTo) -> tuple[float, Callable[[], Result]]:
        delay, effect = super()._plan(goal)

        def with_faults() -> Result:
            self._move_things()
            return self._failure(goal) or effect()

        return delay, with_faults

    def _move_things(self) -> None:
        for fault in self._injector.due(Moved):
            if self._world.held == fault.thing:
                self._injector.strike(fault, f"the robot has the {fault.thing}: it stays")
            else:
                self._injector.strike(fault, f"the {fault.thing} is taken to {fault.place}")
                self._world.things[fault.thing] = fault.place

    def _failure(self, goal: Goal | GoTo) -> Failed | None:
        """How faults make the goal fail; None if they do not."""
        match goal:
            case DriveTo(place):
                return self._dropped() or self._blocked(place)
            case GoTo():
                return self._dropped()
            case Pick(detection):
                return self._stuck() or self._slipped(detection.label)
            case PutDown():
                return self._stuck()
            case _:
                return None

    def _dropped(self) -> Failed | None:
        held = self._world.held
        due = self._injector.due(Drop) if held else ()
        if not (held and due):
            return None
        self._injector.strike(due[0], "the hand lets go")
        self._world.held = None
        self._world.things[held] = FLOOR
        return Failed(f"the {held} fell from my hand", lost=True)

    def _blocked(self, place: str) -> Failed | None:
        """Fail if shut doors leave no way to a place; then they count as struck."""
        shut = self._injector.active(Blocked)
        if not shut or not self._knows(place):
            return None
        here = self._room_at(self._world.pose[:2])
        there = self._room_at(self._world.home.stand(place)[:2])
        if there in self._rooms_from(here, shut):
            return None
        for fault in shut:
            self._injector.strike(fault, f"the door {fault.value} is shut")
        return Failed(f"the way to the {place} is blocked")

    def _slipped(self, name: str) -> Failed | None:
        if self._world.held or not self._injector.draw(Slip, "the fingers slip"):
            return None
        return Failed(f"the {name} slipped from my fingers")

    def _stuck(self) -> Failed | None:
        for fault in self._injector.active(Stuck):
            self._injector.strike(fault, f"{fault.joint} of the arm is stuck")
            return Failed(f"my arm does not follow: {fault.joint} is stuck")
        return None

    def _room_at(self, point: tuple[float, float]) -> str | None:
        rooms = self._world.home.rooms
        return next((room.name for room in rooms if room.holds(*point)), None)

    def _rooms_from(self, start: str | None, shut: tuple[Blocked, ...]) -> set[str | None]:
        """The rooms that can be reached through doors that are not shut."""
        home, closed = self._world.home, [set(fault.rooms) for fault in shut]
        open_ways = [set(rooms) for rooms in doors_between(home.rooms, home.doors).values()]
        open_ways = [rooms for rooms in open_ways if rooms not in closed]
        reached: set[str | None] = {start}
        while new := {r for rooms in open_ways if rooms & reached for r in rooms} - reached:
            reached |= new
        return reached
