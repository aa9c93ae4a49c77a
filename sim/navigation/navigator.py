"""Drives the base to a pose through the home, around obstacles that are not on the map."""

from collections.abc import Callable, Generator

from executive.geometry import Floats
from executive.interfaces.runtime import Recorder
from executive.records import PlannedPath
from sim.body.base import BlockedError, Limits, drive
from sim.body.hardware import Hardware
from sim.body.laser import Laser
from sim.body.skill import Skill, Thinker, pause
from sim.home.furniture import PlanarPose
from sim.navigation.costmap import Costmap
from sim.navigation.grid import OccupancyGrid, Point, Unreachable, plan

SCAN_EVERY = 10
"""Control periods between scans: six scans a second."""
WAYS_TRIED = 8
"""Paths that the robot tries for one goal before it gives up."""
PATIENCE_S = 3.0
"""How long the robot waits for an obstacle on the only path to go away."""


class Navigator:
    """Plans a path with the map and the scans, follows it, and replans when it is blocked."""

    def __init__(
        self,
        hardware: Hardware,
        laser: Laser,
        grid: OccupancyGrid,
        recorder: Recorder,
        now: Callable[[], float],
        thinker: Thinker,
    ) -> None:
        """Use these parts; `now` returns the robot's time (s)."""
        self._hardware = hardware
        self._laser = laser
        self._costmap = Costmap(grid)
        self._recorder = recorder
        self._now = now
        self._thinker = thinker
        self._periods = 0

    def go(self, goal: PlanarPose, limits: Limits) -> Skill:
        """Drive to a pose in `map`.

        Raises:
            Unreachable: if there is no path, or WAYS_TRIED paths were blocked.
        """
        for _ in range(WAYS_TRIED):
            way = yield from self._plan(goal[:2])
            self._recorder.record(PlannedPath(tuple((x, y, 0.0) for x, y in way)))
            try:
                yield from drive(self._hardware, way, goal[2], limits, self._blocked)
                return
            except BlockedError as blocked:
                if blocked.bump is not None:
                    self._costmap.bump(blocked.bump, self._now())
        raise Unreachable("the way to the {place} is blocked")

    def _plan(self, goal: Point) -> Generator[None, None, tuple[Point, ...]]:
        """Plan a path; if marked obstacles leave none, wait, scan again, and try once more."""
        self._look()
        try:
            return (yield from self._way(goal))
        except Unreachable:
            if self._costmap.is_empty:
                raise
        self._costmap.forget(self._now())
        yield from pause(PATIENCE_S)
        self._look()
        return (yield from self._way(goal))

    def _way(self, goal: Point) -> Generator[None, None, tuple[Point, ...]]:
        here = self._here
        return (yield from self._thinker.compute(lambda: plan(self._costmap.grid(), here, goal)))

    def _blocked(self, ahead: Callable[[], Floats]) -> bool:
        """Whether an obstacle blocks the path; scans every SCAN_EVERY calls only."""
        self._periods += 1
        if self._periods % SCAN_EVERY:
            return False
        self._look()
        return self._costmap.blocks(ahead(), self._hardware.base_pose[:2])

    def _look(self) -> None:
        self._costmap.take(self._laser.scan(), self._now())

    @property
    def _here(self) -> Point:
        x, y, _ = self._hardware.base_pose
        return float(x), float(y)
