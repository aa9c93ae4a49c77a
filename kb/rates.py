"""How often people take things elsewhere, and at which hours: learned from what was seen.

A thing is taken elsewhere by chance, at a rate that depends on the hour of the day, on the thing,
on its class and on where it is. Most of what happens nobody sees: between two sightings it may have
been moved at any hour, and back. So the rates, and where things are taken, are estimated by
expectation (`kb.between`) and maximisation (Dempster, Laird and Rubin, "Maximum likelihood from
incomplete data via the EM algorithm", 1977), each rate drawn to that of its class, of the place and
of all things as long as little was seen.
"""

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from executive.geometry import Floats
from kb.between import HOURS, Between, Moves, destinations
from kb.sightings import Interval

UNSEEN_PER_DAY = 0.4
"""How often a thing is moved a day, as long as nothing was seen of any (an estimate)."""
DRAWN_DAYS = 1.0
"""So many days of watching weigh as much as what is known of others alike.

Of 0.5, 1, 1.5, 4 and 8 it had the best log score in simulated households of the seeds 100 to 102;
the numbers here and in `kb.between` that are called estimates hardly mattered there.
"""
ROUNDS = 12
"""Of the estimation. With these and AHEAD it comes as far as with twice as many without."""
AHEAD = 1.0
"""Each round goes on by so much more of its step: as long as most is unseen, steps are short."""
MOST_AHEAD = 3.0
"""No round goes further than by this factor."""


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


@dataclass(frozen=True, slots=True, eq=False)
class Taken:
    """What was likely taken where: how often, by hour of the day.

    Attributes:
        places: the numbers of a thing's places.
        often: (24, n, n) from each place to each other; the last is any where it was never seen.
    """

    places: Mapping[str, int] = field(default_factory=dict)
    often: Floats = field(default_factory=lambda: np.zeros((HOURS, 1, 1)))

    def among(self, numbers: Mapping[str, int]) -> Floats:
        """The same with other numbers for the places, among which are all of these."""
        where = [*(numbers[place] for place in self.places), len(numbers)]
        found = np.zeros((HOURS, len(numbers) + 1, len(numbers) + 1))
        kept = [*self.places.values(), -1]
        found[np.ix_(range(HOURS), where, where)] = self.often[np.ix_(range(HOURS), kept, kept)]
        return found


def learned(
    intervals: Sequence[Interval], classes: Callable[[str], str]
) -> tuple[Rates, dict[str, Taken]]:
    """The rates, and what was taken where, that explain best what was seen."""
    flat = np.full(HOURS, UNSEEN_PER_DAY / HOURS)
    if not intervals:
        return Rates(flat, {}, {}, {}, {}, {}, classes), {}
    between = Between.of(intervals)
    levels = _Levels(between.places, classes)
    moves = between.first_guess()
    rate = np.full(moves.spent.shape, UNSEEN_PER_DAY / HOURS)
    for _ in range(ROUNDS):
        moves = between.moves(rate, destinations(_to_known(moves.taken)))
        rates, found = levels.rates(moves, flat)
        rate = found * np.clip(found / rate, 1 / MOST_AHEAD, MOST_AHEAD) ** AHEAD
    taken = _to_known(moves.taken)
    return rates, {
        thing: Taken(places, taken[number])
        for number, (thing, places) in enumerate(between.places.items())
    }


def _to_known(taken: Floats) -> Floats:
    """Without what was taken to where it was never seen: that is thought of apart."""
    known = taken.copy()
    known[..., -1] = 0.0
    return known


class _Levels:
    """What things at places have in common: the thing, class, place, or two of these."""

    def __init__(
        self, places: Mapping[str, Mapping[str, int]], classes: Callable[[str], str]
    ) -> None:
        self._classes = classes
        pairs = [(thing, place) for thing, known in places.items() for place in known]
        kinds = [classes(thing) for thing, _ in pairs]
        self._thing = _Level([thing for thing, _ in pairs])
        self._place = _Level([place for _, place in pairs])
        self._kind = _Level(kinds)
        self._kind_at = _Level([(k, place) for k, (_, place) in zip(kinds, pairs, strict=True)])
        self._thing_at = _Level(pairs)
        number = {thing: index for index, thing in enumerate(places)}
        self._row = np.array([number[thing] for thing, _ in pairs])
        self._column = np.array([places[thing][place] for thing, place in pairs])

    def rates(self, all_moves: Moves, flat: Floats) -> tuple[Rates, Floats]:
        """Moves over hours, each level drawn to those above it; and (things, 24, n) of them."""
        moves = all_moves.taken.sum(axis=-1)[self._row, :, self._column]
        spent = all_moves.spent[self._row, :, self._column]
        of_all = (moves.sum(axis=0) + DRAWN_DAYS * flat) / (spent.sum(axis=0) + DRAWN_DAYS)
        every = np.broadcast_to(of_all, moves.shape)
        kind = self._kind.drawn(moves, spent, every)
        place = self._place.drawn(moves, spent, every)
        thing = self._thing.drawn(moves, spent, kind)
        kind_at = self._kind_at.drawn(moves, spent, np.sqrt(thing * place))
        thing_at = self._thing_at.drawn(moves, spent, kind_at)
        rate = np.zeros(all_moves.spent.shape)
        rate[self._row] = thing[:, :, None]
        rate[self._row, :, self._column] = thing_at
        rates = Rates(
            of_all,
            self._kind.named(kind),
            self._thing.named(thing),
            self._place.named(place),
            self._kind_at.named(kind_at),
            self._thing_at.named(thing_at),
            self._classes,
        )
        return rates, rate


class _Level:
    """Things at places, grouped by something that they have in common."""

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
        """(n, 24) the rate of each one's group, drawn to (n, 24) of the level above."""
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
