"""Estimates what people have done with things between two sightings, hour by hour.

A hidden Markov model: the state is the place of a thing; at random times people move it, mostly
unseen. Given where the thing was at both ends of an interval, and where it was absent in between,
the forward-backward algorithm (Rabiner, "A tutorial on hidden Markov models", 1989) gives the
probability of each place and of each move in every hour. All intervals are processed in parallel.
"""

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from executive.belief import MISSED
from executive.geometry import Floats
from kb.sightings import Interval

HOURS = 24
SLOTS = 2 * HOURS
"""The 24 hours of a weekday, then the 24 hours of a day of the weekend."""
HOUR_S = 3600.0
DAY_S = 86400.0
LONGEST_S = 14 * DAY_S
"""A last sighting that is older counts as if it were this old."""
MOST_PLACES = 12
"""Only this many places of each thing are distinguished, the most frequent ones."""
HARDLY = 1e-9
"""Minimum probability, so that no sighting is impossible."""
_THURSDAY, _SATURDAY = 3, 5
"""Weekdays (Monday is 0); 1970-01-01 was a Thursday."""


def slots(hours: NDArray[np.intp]) -> NDArray[np.intp]:
    """The slot of each hour, which is counted from the beginning of 1970 (UTC)."""
    weekend = (hours // HOURS + _THURSDAY) % 7 >= _SATURDAY
    return hours % HOURS + HOURS * weekend


def goes(rate: Floats, hours: Floats) -> Floats:
    """Probability that a thing is taken away within these hours, at this rate (per hour)."""
    return np.asarray(-np.expm1(-rate * hours))


@dataclass(frozen=True, slots=True)
class Moves:
    """Expected moves and durations of each thing.

    Attributes:
        taken: (things, SLOTS, n, n) number of moves from one place to another in each slot; the
            last place stands for all that are not among the places of the thing.
        spent: (things, SLOTS, n) hours at each place.
    """

    taken: Floats
    spent: Floats

    @classmethod
    def none(cls, things: int, places: int) -> Self:
        """No moves and no hours."""
        spent = np.zeros((things, SLOTS, places))
        return cls(np.zeros((*spent.shape, places)), spent)


@dataclass(frozen=True, slots=True, eq=False)
class Between:
    """The intervals, divided into steps of at most an hour; those with most steps come first.

    Attributes:
        places: for each thing, its places and their indices.
        thing: (intervals,) index of the thing.
        start: (intervals,) index of the first place; -1: none of its places.
        end: (intervals,) index of the place where it was found; -1 as for `start`.
        steps: (intervals,) number of steps.
        hours: (intervals, steps) duration of each step (h).
        slot: (intervals, steps) slot of each step.
        absent: (intervals, steps) place where it was not seen at the end of the step; -1: none.
    """

    places: Mapping[str, Mapping[str, int]]
    thing: NDArray[np.intp]
    start: NDArray[np.intp]
    end: NDArray[np.intp]
    steps: NDArray[np.intp]
    hours: Floats
    slot: NDArray[np.int8]
    absent: NDArray[np.int8]

    @classmethod
    def of(cls, intervals: Sequence[Interval]) -> Self:
        """Divide these intervals into steps; there must be at least one interval."""
        seen: dict[str, Counter[str]] = defaultdict(Counter)
        for one in intervals:
            seen[one.thing].update((one.place, one.at))
        places = {
            thing: {place: i for i, (place, _) in enumerate(count.most_common(MOST_PLACES))}
            for thing, count in seen.items()
        }
        told = [(one, *_steps(one, places[one.thing])) for one in intervals]
        told.sort(key=lambda each: -len(each[1]))
        shape = len(told), len(told[0][1])
        hours, slot = np.zeros(shape), np.zeros(shape, np.int8)
        absent = np.full(shape, -1, np.int8)
        for row, (_, lengths, at, missed) in enumerate(told):
            hours[row, : len(lengths)], slot[row, : len(at)] = lengths, at
            absent[row, : len(missed)] = missed
        number = {thing: index for index, thing in enumerate(places)}
        return cls(
            places,
            np.array([number[one.thing] for one, *_ in told]),
            np.array([places[one.thing].get(one.place, -1) for one, *_ in told]),
            np.array([places[one.thing].get(one.at, -1) for one, *_ in told]),
            np.array([len(lengths) for _, lengths, *_ in told]),
            hours,
            slot,
            absent,
        )

    @property
    def size(self) -> int:
        """Maximum number of places of a thing, including the unknown one."""
        return 1 + max(map(len, self.places.values()))

    def moves(self, rate: Floats) -> Moves:
        """Expected moves and durations, given these rates (the E step).

        Args:
            rate: (things, SLOTS, n, n) moves per hour from each place to each other.
        """
        n = self.size
        leaving = rate.sum(axis=-1)
        to = rate / np.maximum(leaving, HARDLY)[..., None]
        before, seen = self._forward(leaving, to)
        taken, spent = np.zeros(to.shape), np.zeros(leaving.shape)
        flat_taken, flat_spent = taken.reshape(-1, n, n), spent.reshape(-1, n)
        after = np.ones((0, n))
        for step in reversed(range(len(before))):
            at, key, go = self._at(step, leaving)
            later = np.ones((len(at), n))
            later[: len(after)] = after
            later *= seen[step]
            leaves, where = before[step] * go, to[self.thing[at], self.slot[at, step]]
            np.add.at(flat_taken, key, leaves[:, :, None] * where * later[:, None, :])
            stays = (1 - go) * later
            after = stays + go * np.einsum("ast,at->as", where, later)
            np.add.at(flat_spent, key, before[step] * after * self.hours[at, step, None])
        return Moves(taken, spent)

    def _forward(self, leaving: Floats, to: Floats) -> tuple[list[Floats], list[Floats]]:
        """For each step: probabilities of the places before it, and likelihoods after it.

        The likelihoods are scaled, so that their products with the probabilities after the step
        sum to 1.
        """
        likely = np.zeros((len(self.thing), self.size))
        likely[np.arange(len(likely)), self.start] = 1.0
        before, seen = [], []
        for step in range(self.hours.shape[1]):
            at, _, go = self._at(step, leaving)
            likely = likely[: len(at)]
            before.append(likely)
            where = to[self.thing[at], self.slot[at, step]]
            likely = likely * (1 - go) + np.einsum("as,ast->at", likely * go, where)
            fits = self._likelihoods(at, step)
            likely = likely * fits
            total = likely.sum(axis=1, keepdims=True)
            seen.append(fits / total)
            likely = likely / total
        return before, seen

    def _at(self, step: int, leaving: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
        """For a step: the intervals that have it, their index of thing and slot, and P(leaving)."""
        at = np.arange(int((self.steps > step).sum()))
        thing, slot = self.thing[at], self.slot[at, step]
        return at, thing * SLOTS + slot, goes(leaving[thing, slot], self.hours[at, step, None])

    def _likelihoods(self, at: NDArray[np.intp], step: int) -> Floats:
        """(intervals, n) likelihood of what was seen after a step, given each place."""
        fits = np.ones((len(at), self.size))
        missed = np.flatnonzero(self.absent[at, step] >= 0)
        fits[missed, self.absent[missed, step]] = MISSED
        last = np.flatnonzero(self.steps[at] == step + 1)
        fits[last] = HARDLY
        fits[last, self.end[last]] = 1.0
        return fits


def _steps(
    one: Interval, places: Mapping[str, int]
) -> tuple[Floats, NDArray[np.intp], NDArray[np.intp]]:
    """Durations of the steps (h), their slots, and where the thing was absent at the end, or -1.

    A step ends at the full hour, or when the thing was not seen at one of its places.
    """
    since, until = max(one.since_s, one.until_s - LONGEST_S) / HOUR_S, one.until_s / HOUR_S
    missed = [(time_s / HOUR_S, places[place]) for time_s, place in one.absences if place in places]
    ends = [(hour, -1) for hour in np.arange(np.floor(since) + 1, np.ceil(until)).tolist()]
    ends += [(time, place) for time, place in missed if since < time < until]
    ends = [*sorted(ends), (until, -1)]
    edges = np.array([since, *(time for time, _ in ends)])
    slot = slots(np.floor(edges[:-1] + HARDLY).astype(np.intp))
    return np.diff(edges), slot, np.array([place for _, place in ends])
