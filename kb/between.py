"""What people have likely done with things between two sightings, hour by hour of the day.

A thing is at one place or another, and is moved by chance; most of it nobody sees. What is known at
both ends, and where the thing was not in between, says how likely it was where at every hour, and
what was taken where (forward and backward through a hidden Markov model: Rabiner, "A tutorial on
hidden Markov models", 1989). All intervals are worked out side by side.
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
HOUR_S = 3600.0
DAY_S = 86400.0
LONGEST_S = 14 * DAY_S
"""What was last seen earlier is as if it had been then."""
NEW_PLACE = 0.3
"""As if so often a thing had been taken to a place where it was never seen.

Of 0.2, 0.6 and 1.5 the least had the best log score in simulated households of the seeds 100 and
101.
"""
OTHER_ORIGIN = 0.2
"""How much a move from another place counts, beside one from the same (an estimate)."""
ANY_HOUR = 0.05
"""How much a move at another hour of the day counts, beside one at the same (an estimate)."""
NEAR = (0.15, 0.5, 1.0, 0.5, 0.15)
"""How much a move counts that was from two hours before to two hours later (an estimate)."""
MOST_PLACES = 12
"""Of each thing so many places are told apart, those where it was most often."""
HARDLY = 1e-9
"""No sighting is ruled out."""


def destinations(taken: Floats) -> Floats:
    """(..., 24, n, n) from each place at each hour to each place; the last is an unknown one.

    Args:
        taken: (..., 24, n, n) how often things were taken from each place to each other one.
    """
    shifts = zip(NEAR, range(-2, 3), strict=True)
    near = np.sum([weight * np.roll(taken, by, axis=-3) for weight, by in shifts], axis=0)
    at = near + ANY_HOUR * taken.sum(axis=-3, keepdims=True)
    count = (1 - OTHER_ORIGIN) * at + OTHER_ORIGIN * at.sum(axis=-2, keepdims=True)
    places = np.arange(taken.shape[-1] - 1)
    count[..., places, places] = 0.0
    count[..., -1] = NEW_PLACE
    shares: Floats = count / count.sum(axis=-1, keepdims=True)
    return shares


def goes(rate: Floats, hours: Floats) -> Floats:
    """How likely a thing is taken away in so many hours, at this rate."""
    return np.asarray(-np.expm1(-rate * hours))


@dataclass(frozen=True, slots=True)
class Moves:
    """What was likely done with each thing.

    Attributes:
        taken: (things, 24, n, n) how often each was taken from one place to another in each hour of
            the day; the last place stands for those where it was never seen.
        spent: (things, 24, n) how many hours it was there.
    """

    taken: Floats
    spent: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Between:
    """The steps of all intervals, those with most steps first: up to an hour each.

    Attributes:
        places: of each thing, the numbers of its places.
        thing: (intervals,) which thing.
        start: (intervals,) where it was; -1: at none of its places.
        end: (intervals,) where it was found; -1 as well.
        steps: (intervals,) how many steps.
        hours: (intervals, steps) how long each is (h).
        hour: (intervals, steps) of the day.
        absent: (intervals, steps) the place where it was not seen at the end of the step, or -1.
    """

    places: Mapping[str, Mapping[str, int]]
    thing: NDArray[np.intp]
    start: NDArray[np.intp]
    end: NDArray[np.intp]
    steps: NDArray[np.intp]
    hours: Floats
    hour: NDArray[np.int8]
    absent: NDArray[np.int8]

    @classmethod
    def of(cls, intervals: Sequence[Interval]) -> Self:
        """The steps of these, one at least."""
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
        hours, hour = np.zeros(shape), np.zeros(shape, np.int8)
        absent = np.full(shape, -1, np.int8)
        for row, (_, lengths, at, missed) in enumerate(told):
            hours[row, : len(lengths)], hour[row, : len(at)] = lengths, at
            absent[row, : len(missed)] = missed
        number = {thing: index for index, thing in enumerate(places)}
        return cls(
            places,
            np.array([number[one.thing] for one, *_ in told]),
            np.array([places[one.thing].get(one.place, -1) for one, *_ in told]),
            np.array([places[one.thing].get(one.at, -1) for one, *_ in told]),
            np.array([len(lengths) for _, lengths, *_ in told]),
            hours,
            hour,
            absent,
        )

    @property
    def size(self) -> int:
        """How many places a thing has at most, with the unknown one."""
        return 1 + max(map(len, self.places.values()))

    def first_guess(self) -> Moves:
        """Each thing that was found elsewhere was moved once, at any time."""
        taken = np.zeros((len(self.places), HOURS, self.size, self.size))
        share = self.hours / np.maximum(self.hours.sum(axis=1, keepdims=True), HARDLY)
        moved = self.start != self.end
        rows = [np.broadcast_to(each[:, None], share.shape) for each in (self.thing, self.start)]
        to = np.broadcast_to(self.end[:, None], share.shape)
        index = tuple(each[moved] for each in (rows[0], self.hour, rows[1], to))
        np.add.at(taken, index, share[moved])
        return Moves(taken, np.zeros(taken.shape[:3]))

    def moves(self, rate: Floats, to: Floats) -> Moves:
        """What was likely done, by these rates and destinations.

        Args:
            rate: (things, 24, n) moves an hour.
            to: (things, 24, n, n) as `destinations` has it.
        """
        n = self.size
        before, seen = self._forward(rate, to)
        taken, spent = np.zeros(to.shape), np.zeros(rate.shape)
        flat_taken, flat_spent = taken.reshape(-1, n, n), spent.reshape(-1, n)
        after = np.ones((0, n))
        for step in reversed(range(len(before))):
            at, key, go = self._at(step, rate)
            later = np.ones((len(at), n))
            later[: len(after)] = after
            later *= seen[step]
            leaves, where = before[step] * go, to[self.thing[at], self.hour[at, step]]
            np.add.at(flat_taken, key, leaves[:, :, None] * where * later[:, None, :])
            stays = (1 - go) * later
            after = stays + go * np.einsum("ast,at->as", where, later)
            np.add.at(flat_spent, key, before[step] * after * self.hours[at, step, None])
        return Moves(taken, spent)

    def _forward(self, rate: Floats, to: Floats) -> tuple[list[Floats], list[Floats]]:
        """Of each step, where things likely were before it; and how well each place fits after it.

        What fits is scaled, so that all that follows from it are probabilities.
        """
        likely = np.zeros((len(self.thing), self.size))
        likely[np.arange(len(likely)), self.start] = 1.0
        before, seen = [], []
        for step in range(self.hours.shape[1]):
            at, _, go = self._at(step, rate)
            likely = likely[: len(at)]
            before.append(likely)
            where = to[self.thing[at], self.hour[at, step]]
            likely = likely * (1 - go) + np.einsum("as,ast->at", likely * go, where)
            fits = self._fits(at, step)
            likely = likely * fits
            total = likely.sum(axis=1, keepdims=True)
            seen.append(fits / total)
            likely = likely / total
        return before, seen

    def _at(self, step: int, rate: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
        """The intervals that have this step, thing with hour as one number, and what leaves."""
        at = np.arange(int((self.steps > step).sum()))
        thing, hour = self.thing[at], self.hour[at, step]
        return at, thing * HOURS + hour, goes(rate[thing, hour], self.hours[at, step, None])

    def _fits(self, at: NDArray[np.intp], step: int) -> Floats:
        """(intervals, n) how well what was seen after a step fits to each place."""
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
    """How long each step is (h), its hour of the day, and where the thing was not after it or -1.

    A step ends with the hour, or where something was seen.
    """
    since, until = max(one.since_s, one.until_s - LONGEST_S) / HOUR_S, one.until_s / HOUR_S
    missed = [(time_s / HOUR_S, places[place]) for time_s, place in one.absences if place in places]
    ends = [(hour, -1) for hour in np.arange(np.floor(since) + 1, np.ceil(until)).tolist()]
    ends += [(time, place) for time, place in missed if since < time < until]
    ends = [*sorted(ends), (until, -1)]
    edges = np.array([since, *(time for time, _ in ends)])
    hour = np.floor(edges[:-1] + HARDLY).astype(np.intp) % HOURS
    return np.diff(edges), hour, np.array([place for _, place in ends])
