"""How often people take things elsewhere, and at which hours: learned from what was seen.

A thing is taken elsewhere by chance, at a rate that depends on the hour of the day, on the thing,
on its class and on where it is. Most of what happens nobody sees: between two sightings it may have
been moved at any hour. So the rates are estimated by expectation and maximisation (Dempster, Laird
and Rubin, "Maximum likelihood from incomplete data via the EM algorithm", 1977), each drawn to that
of its class, of the place and of all things as long as little was seen.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from executive.geometry import Floats
from kb.sightings import Interval

HOURS = 24
HOUR_S = 3600.0
DAY_S = 86400.0
UNSEEN_PER_DAY = 0.4
"""How often a thing is moved a day, as long as nothing was seen of any (an estimate)."""
DRAWN_DAYS = 1.0
"""So many days of watching weigh as much as what is known of others alike.

Of 0.5, 1, 1.5, 4 and 8 it had the best log score in simulated households of the seeds 100 to 102;
the numbers here and in `kb.experience` that are called estimates hardly mattered there.
"""
ROUNDS = 8
"""Of the estimation."""
LONGEST_S = 14 * DAY_S
"""What was last seen earlier is as if it had been then."""


@dataclass(frozen=True, slots=True, eq=False)
class Rates:
    """Moves an hour, by the hour of the day: (24,) each.

    Attributes:
        of_all: of things in general.
        of_class: of each class of things.
        of_thing: of each thing.
        of_place: of what is at each place.
        of_class_at: of each class at each place.
        of_thing_at: of each thing at each place.
        classes: tells the class of a thing.
    """

    of_all: Floats
    of_class: Mapping[str, Floats]
    of_thing: Mapping[str, Floats]
    of_place: Mapping[str, Floats]
    of_class_at: Mapping[tuple[str, str], Floats]
    of_thing_at: Mapping[tuple[str, str], Floats]
    classes: Callable[[str], str]

    def of(self, thing: str, place: str) -> Floats:
        """Of a thing at a place, as well as it is known."""
        if (thing, place) in self.of_thing_at:
            return self.of_thing_at[thing, place]
        kind = self.classes(thing)
        if (kind, place) in self.of_class_at:
            return self.of_class_at[kind, place]
        by_thing = self.of_thing.get(thing, self.of_class.get(kind, self.of_all))
        blend: Floats = np.sqrt(by_thing * self.of_place.get(place, self.of_all))
        return blend


def exposure(since_s: float, until_s: float) -> Floats:
    """(24,) how many hours of each hour of the day there are between two times (UTC, s)."""
    since_s = max(since_s, until_s - LONGEST_S)
    days, rest = divmod(until_s - since_s, DAY_S)
    begin = since_s % DAY_S / HOUR_S
    edges = np.arange(2 * HOURS + 1)
    inside = np.minimum(edges[1:], begin + rest / HOUR_S) - np.maximum(edges[:-1], begin)
    hours: Floats = days + np.clip(inside, 0.0, None).reshape(2, HOURS).sum(axis=0)
    return hours


def learned(intervals: Sequence[Interval], classes: Callable[[str], str]) -> Rates:
    """The rates that explain best what was seen."""
    flat = np.full(HOURS, UNSEEN_PER_DAY / HOURS)
    if not intervals:
        return Rates(flat, {}, {}, {}, {}, {}, classes)
    levels = _Levels(intervals, classes)
    spent = np.array([exposure(i.since_s, i.until_s) for i in intervals])
    moved = np.array([i.at != i.place for i in intervals])
    back = _returned(intervals)
    now = np.tile(flat, (len(intervals), 1))
    for _ in range(ROUNDS):
        rates, now = levels.rates(_moves(now * spent, moved, back), spent, flat)
    return rates


def _returned(intervals: Sequence[Interval]) -> Floats:
    """(n,) how likely each thing is taken to where it was, when it is taken somewhere."""
    seen: dict[str, Counter[str]] = defaultdict(Counter)
    for i in intervals:
        if i.at:
            seen[i.thing][i.at] += 1
    shares = ((seen[i.thing][i.place] + 0.1) / (seen[i.thing].total() + 1.0) for i in intervals)
    return np.fromiter(shares, dtype=float)


def _moves(expected: Floats, moved: NDArray[np.bool_], back: Floats) -> Floats:
    """(n, 24) how often each thing was moved in each hour of the day, by what was seen.

    What was seen at the same place again may have been taken away and back.
    """
    total = np.maximum(expected.sum(axis=1), 1e-12)
    stayed = np.exp(-total)
    away = 0.5 * (1 - stayed) ** 2 * back
    was_moved = np.where(moved, 1.0, away / (stayed + away + 1e-12))
    moves: Floats = expected * (was_moved / -np.expm1(-total))[:, None]
    return moves


class _Levels:
    """What the intervals have in common: the same thing, class, place, or two of these."""

    def __init__(self, intervals: Sequence[Interval], classes: Callable[[str], str]) -> None:
        self._classes = classes
        things = [i.thing for i in intervals]
        places = [i.place for i in intervals]
        kinds = [classes(thing) for thing in things]
        self._thing, self._place = _Level(things), _Level(places)
        self._kind = _Level(kinds)
        self._kind_at = _Level(list(zip(kinds, places, strict=True)))
        self._thing_at = _Level(list(zip(things, places, strict=True)))

    def rates(self, moves: Floats, spent: Floats, flat: Floats) -> tuple[Rates, Floats]:
        """Moves over hours, each level drawn to those above it; and (n, 24) of each interval."""
        of_all = (moves.sum(axis=0) + DRAWN_DAYS * flat) / (spent.sum(axis=0) + DRAWN_DAYS)
        every = np.broadcast_to(of_all, moves.shape)
        kind = self._kind.drawn(moves, spent, every)
        place = self._place.drawn(moves, spent, every)
        thing = self._thing.drawn(moves, spent, kind)
        kind_at = self._kind_at.drawn(moves, spent, np.sqrt(thing * place))
        thing_at = self._thing_at.drawn(moves, spent, kind_at)
        rates = Rates(
            of_all,
            self._kind.named(kind),
            self._thing.named(thing),
            self._place.named(place),
            self._kind_at.named(kind_at),
            self._thing_at.named(thing_at),
            self._classes,
        )
        return rates, thing_at


class _Level:
    """Intervals grouped by something that they have in common."""

    def __init__(self, keys: Sequence[Hashable]) -> None:
        self._first: dict[Hashable, int] = {}
        for index, key in enumerate(keys):
            self._first.setdefault(key, index)
        numbers = {key: number for number, key in enumerate(self._first)}
        self._of = np.array([numbers[key] for key in keys])
        self._count = len(numbers)
        rows = np.arange(len(keys))
        self._groups = csr_array((np.ones(len(keys)), (self._of, rows)))

    def drawn(self, moves: Floats, spent: Floats, above: Floats) -> Floats:
        """(n, 24) the rate of each interval's group, drawn to (n, 24) of the level above."""
        moved, passed, drawn_to = map(self._summed, (moves, spent, above))
        members = np.bincount(self._of, minlength=self._count)[:, None]
        rate: Floats = (moved + DRAWN_DAYS * drawn_to / members) / (passed + DRAWN_DAYS)
        each: Floats = rate[self._of]
        return each

    def _summed(self, values: Floats) -> Floats:
        """(groups, 24) the sum of each group."""
        sums: Floats = np.asarray(self._groups @ values)
        return sums

    def named(self, rates: Floats) -> dict[Any, Floats]:
        """The rate of each group."""
        return {key: rates[first] for key, first in self._first.items()}
