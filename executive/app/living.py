"""A simulated home that persists: things stay where they were left when a program ends."""

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
    """The things and the time of a home, kept between missions and between programs.

    Between two missions the residents move things by their habits; during a mission nobody moves
    anything.

    A thing that is on no furniture at the end of a mission, in the hand or on the floor, is at its
    place before the mission when the next program starts: the residents have put it back.
    """

    def __init__(self, settings: Settings, home: Home) -> None:
        """Read where the things were left.

        Raises:
            InputError: if the file is malformed, or is for another home.
        """
        self._file = settings.home_state
        before = read_state(self._file, home) if self._file else None
        spots = dict(before.objects) if before else {}
        self.left = {name: spot for name, spot in spots.items() if name not in settings.place}
        """Where things were left, but for those that `--place` puts somewhere."""
        self.home = home.as_left(self.left)
        self._spots = dict(self.home.objects)
        self._habits = load_habits(settings.habits, home) if settings.habits else None
        self._seed, self._hours = settings.seed, settings.hours_between
        self._lived_s = before.time_s if before else None
        self._time_s = max(time.time(), before.time_s if before else 0.0)
        self._world: Furnished | None = None
        self._during: Clock | None = None

    def now(self) -> float:
        """The time in the home: UTC (s).

        If the home is kept or has residents, its time begins no earlier than when things were left,
        and goes on by missions and the time between them. Otherwise it is the real time.
        """
        if self._world is None:
            return time.time()
        return self._time_s + (self._during.now() if self._during else 0.0)

    def move_in(self, embodiment: Embodiment) -> Embodiment:
        """Connect the home with an embodiment, so that its state is kept and its habits apply.

        Raises:
            InputError: if the world is not one of ours, or the file cannot be written.
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
            self._advance()
            self._during = clock
            begin()

        return replace(embodiment, begin=begin_mission, end=self._end, pause=self._pause)

    def _pause(self, seconds: float) -> None:
        """Advance the time of the home before the next mission; returns at once."""
        self._time_s += seconds

    def _advance(self) -> None:
        """Let `hours_between` pass, and apply the residents' moves since the last mission."""
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
        """Save where things are now; if the file cannot be written, only warn."""
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
    """The place and pose alone, without the other values of an entry in a home file."""
    return Spot.model_construct(
        furniture=spot.furniture, surface=spot.surface, at=spot.at, yaw=spot.yaw
    )
