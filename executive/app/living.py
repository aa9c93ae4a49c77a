"""A simulated home that goes on living: things stay where they were left, program after program."""

import logging
import time
from dataclasses import replace
from pathlib import Path

from executive.app.embodiment import Embodiment, Furnished
from executive.config import Settings
from executive.errors import InputError
from executive.interfaces.runtime import Clock
from executive.text import printable
from sim.home.arrangement import Spot
from sim.home.habits import load_habits, moves
from sim.home.home import Home
from sim.home.state import RIGHT, HomeState, read_state, write_state

log = logging.getLogger(__name__)


class LivingHome:
    """The things and the time of a home, from one mission to the next and to the next program.

    Between two missions things are taken elsewhere as the habits of those who live there have it;
    while the robot is at it, nobody takes anything.

    What is on no furniture when a mission ends, in the hand or on the floor, is put back to where
    it was before by whoever lives there, once the program has ended.
    """

    def __init__(self, settings: Settings, home: Home) -> None:
        """Know where the things were left.

        Raises:
            InputError: if the file is none of ours, or does not fit to the home.
        """
        self._file = settings.home_state
        before = read_state(self._file, home) if self._file else None
        spots = dict(before.objects) if before else {}
        self.left = {name: spot for name, spot in spots.items() if name not in settings.place}
        """What is elsewhere than the home file and `--place` say."""
        self.home = home.as_left(self.left)
        self._spots = dict(self.home.objects)
        self._habits = load_habits(settings.habits, home) if settings.habits else None
        self._seed, self._hours = settings.seed, settings.hours_between
        self._lived_s = before.time_s if before else None
        self._time_s = max(time.time(), before.time_s if before else 0.0)
        self._world: Furnished | None = None
        self._during: Clock | None = None

    def now(self) -> float:
        """What time it is there: UTC (s); it is never earlier than when things were left."""
        if self._world is None:
            return time.time()
        return self._time_s + (self._during.now() if self._during else 0.0)

    def move_in(self, embodiment: Embodiment) -> Embodiment:
        """Have the home live with this body from now on.

        Raises:
            InputError: if the body is in no world of ours, or the file cannot be written.
        """
        asked = [name for name, on in (("home_state", self._file), ("habits", self._habits)) if on]
        if not asked:
            return embodiment
        if embodiment.keeps is None:
            right = "use --world physics or fake, or leave it out"
            what = "a world that is not ours is left as it is, and nothing of it can be kept"
            raise InputError(f"setting '{asked[0]}'", what, right)
        self._world = embodiment.keeps
        if self._file:
            self._write(self._file)
        begin, clock = embodiment.begin, embodiment.clock

        def begin_mission() -> None:
            self._live_on()
            self._during = clock
            begin()

        return replace(embodiment, begin=begin_mission, end=self._end, pause=self._pause)

    def _pause(self, seconds: float) -> None:
        """Let time pass before the next mission."""
        self._time_s += seconds

    def _live_on(self) -> None:
        """Let the time pass that nothing was asked for, and people do what they are used to."""
        since = self._time_s if self._lived_s is None else self._lived_s
        self._time_s += self._hours * 3600.0
        if self._habits and self._world:
            for move in moves(self._habits, self.home, since, self._time_s, self._seed):
                spots = self._world.left()
                here = spots[move.thing].furniture if move.thing in spots else ""
                if move.fits(here):
                    self._world.put(move.thing, move.to)
        self._lived_s = self._time_s

    def _end(self) -> None:
        """Keep where things are now; that it cannot be written is no reason to end otherwise."""
        self._time_s, self._during = self.now(), None
        self._lived_s = self._time_s
        if self._file is None:
            return
        try:
            self._write(self._file)
        except InputError as error:
            log.warning("%s", error)

    def _write(self, file: Path) -> None:
        assert self._world
        self._spots |= self._world.left()
        pieces = {name: _plain(spot) for name, spot in self._spots.items()}
        try:
            write_state(file, HomeState(home=self.home.name, time_s=self._time_s, objects=pieces))
        except OSError as error:
            what = f"where things are could not be kept: {error.strerror}"
            raise InputError(printable(file), what, RIGHT) from None


def _plain(spot: Spot) -> Spot:
    """Where it is, without what else an entry of a home file says."""
    return Spot.model_construct(
        furniture=spot.furniture, surface=spot.surface, at=spot.at, yaw=spot.yaw
    )
