"""Estimates at which rates people move things, by hour: learned from sightings.

A move is a random event. Its rate depends on the thing, its place, the hour, and whether it is the
weekend. Most moves are not seen: between two sightings, a thing may have been moved at any hour,
even there and back. So the rates are estimated by expectation maximisation (the E step is
`kb.between`; Dempster, Laird and Rubin, "Maximum likelihood from incomplete data via the EM
algorithm", 1977). With little data, each rate is shrunk towards a more general one: of any day, of
any place, of the class, of all things.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from executive.geometry import Floats
from kb.between import HARDLY, HOURS, SLOTS, Between, Moves
from kb.sightings import Interval

UNSEEN_PER_DAY = 0.4
"""Moves per day of a thing, before any was seen (an estimate)."""
DRAWN_DAYS = 1.0
"""Weight of the more general rate, as days of observation."""
FROM_DAYS = 4.0
"""The same for the rate from one place, which is shrunk towards the rate from any place.

In simulated households (seeds 1 to 4), 1 instead of 4 made hardly any difference.
"""
NEW_PLACE = 0.3
"""Pseudo-count of moves to places where the thing was never seen (an estimate)."""
ROUNDS = 12
"""Iterations of the EM; with MOST_AHEAD they get as far as twice as many without it."""
MOST_AHEAD = 3.0
"""Over-relaxation: each iteration repeats its step, which is small where most moves are unseen,
limited to this factor.
"""
KINDS_OF_DAY = SLOTS // HOURS
DAYS_A_WEEK = (5, 2)
"""Days a week of each kind of day."""


@dataclass(frozen=True, slots=True, eq=False)
class Rates:
    """Rates of moves (per hour).

    Attributes:
        of_all: (24,) of things in general, by hour of the day.
        of_class: (24,) of each class of things.
        places: for each thing, its places and their indices.
        to: (SLOTS, n, n) for each thing, from each place to each other; the last index is any
            other place.
        classes: returns the class of a thing.
    """

    of_all: Floats
    of_class: Mapping[str, Floats]
    places: Mapping[str, Mapping[str, int]]
    to: Mapping[str, Floats]
    classes: Callable[[str], str]

    def of(self, thing: str, place: str) -> Floats:
        """(24,) rate at which a thing is taken away from a place, by hour; mean of the week."""
        if thing not in self.to:
            return self.of_class.get(self.classes(thing), self.of_all)
        away = self.to[thing][:, self.places[thing].get(place, -1)].sum(axis=-1)
        by_kind = away.reshape(KINDS_OF_DAY, HOURS)
        mean: Floats = np.average(by_kind, axis=0, weights=DAYS_A_WEEK)
        return mean

    def among(self, thing: str, places: Sequence[str]) -> Floats:
        """(SLOTS, n + 1, n + 1) rates between these places; the last index is any other place."""
        found = np.zeros((SLOTS, len(places) + 1, len(places) + 1))
        if thing not in self.to:
            found[:, :-1, -1] = np.tile(self.of(thing, ""), KINDS_OF_DAY)[:, None]
            return found
        to, numbers = self.to[thing], self.places[thing]
        here = [*(i for i, place in enumerate(places) if place in numbers), len(places)]
        theirs = [*(numbers[place] for place in places if place in numbers), -1]
        from_each = [*(numbers.get(place, -1) for place in places), -1]
        found[:, :, here] = to[:, from_each][:, :, theirs]
        return found


def learned(intervals: Sequence[Interval], classes: Callable[[str], str]) -> Rates:
    """Estimate the rates that explain the intervals best; without any, `UNSEEN_PER_DAY` for all."""
    if not intervals:
        return Rates(np.full(HOURS, UNSEEN_PER_DAY / HOURS), {}, {}, {}, classes)
    between = Between.of(intervals)
    general = _General(between, classes)
    rate = general.rates(Moves.none(len(between.places), between.size)).each
    for _ in range(ROUNDS):
        found = general.rates(between.moves(rate))
        step = np.clip(found.each / np.maximum(rate, HARDLY), 1 / MOST_AHEAD, MOST_AHEAD)
        rate = found.each * step
    kinds = zip(general.kinds, found.of_class, strict=True)
    to = dict(zip(between.places, found.each, strict=True))
    return Rates(found.of_all, dict(kinds), between.places, to, classes)


@dataclass(frozen=True, slots=True, eq=False)
class _Estimate:
    """Rates (24,) of all things, (kinds, 24) of classes, (things, SLOTS, n, n) of each thing."""

    of_all: Floats
    of_class: Floats
    each: Floats


class _General:
    """The structure that things share, and the rates they are shrunk towards."""

    def __init__(self, between: Between, classes: Callable[[str], str]) -> None:
        of_each = [classes(thing) for thing in between.places]
        self.kinds = tuple(dict.fromkeys(of_each))
        self._kind = np.array([self.kinds.index(kind) for kind in of_each])
        self._members = (self._kind == np.arange(len(self.kinds))[:, None]).astype(float)
        count = np.array([len(places) for places in between.places.values()])
        self._others = np.maximum(count - 1, 1)
        self._known = (np.arange(between.size) < count[:, None])[:, None]
        self._ways = self._known.swapaxes(1, 2) & self._known & ~np.eye(between.size, dtype=bool)

    def rates(self, moves: Moves) -> _Estimate:
        """The M step: moves / hours, each rate shrunk towards a more general one."""
        by_kind_of_day = len(moves.spent), KINDS_OF_DAY, HOURS
        taken = moves.taken.reshape(*by_kind_of_day, *self._ways.shape[1:])
        taken = taken * self._ways[:, None, None]
        spent = moves.spent.reshape(*by_kind_of_day, -1).copy()
        spent[..., -1] = 0.0
        any_day, there = taken.sum(axis=1), spent.sum(axis=1)
        left, watched = any_day.sum(axis=(2, 3)), there.sum(axis=2)
        # to anywhere: of all things, of each class
        of_all = _shrunk(left.sum(axis=0), watched.sum(axis=0), UNSEEN_PER_DAY / HOURS)
        of_class = _shrunk(self._members @ left, self._members @ watched, of_all)
        # of each thing: to each place from anywhere, from each place on any day, on such a day
        usual = of_class[self._kind]
        to_each = (usual / self._others[:, None])[:, :, None]
        to = _shrunk(any_day.sum(axis=2), watched[:, :, None] - there, to_each) * self._known
        on_any_day = _shrunk(any_day, there[..., None], to[:, :, None, :], FROM_DAYS)
        rate = _shrunk(taken, spent[..., None], on_any_day[:, None]) * self._ways[:, None, None]
        # from and to a place where it was never seen
        rate[..., -1, :] = to[:, None]
        new = NEW_PLACE / (left.sum(axis=1) + NEW_PLACE)
        to_new = _shrunk(left, watched, usual).mean(axis=1) * new
        rate[..., :-1, -1] = to_new[:, None, None, None]
        return _Estimate(of_all, of_class, rate.reshape(moves.taken.shape))


def _shrunk(moved: Floats, passed: Floats, to: Floats | float, days: float = DRAWN_DAYS) -> Floats:
    """Moves per hour, shrunk towards the rate `to`, which weighs as much as so many days."""
    rate: Floats = (moved + days * to) / (passed + days)
    return rate
