"""Learns from sightings how long they stay valid, and where people take things.

From its last known place, a thing is followed hour by hour with a hidden Markov model: the
probability that it has stayed, and of each place where it may be now. Every later look at a place
counts as evidence, whatever was looked for.
"""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from executive.belief import MISSED, Belief, Statement, believe
from executive.geometry import Floats
from executive.types.knowledge import Source
from kb.between import HARDLY, HOUR_S, LONGEST_S, goes, slots
from kb.facts import FactStore
from kb.rates import Rates, learned
from kb.sightings import Known, Sightings

MOST_LEARNED = 5_000
"""Of the facts that are new, only so many of the latest are learned from: it takes about a second,
and they are some eleven weeks of ten commands a day."""
MOST_TRUSTED = 0.98
"""Maximum trust in a source: the thing may always be elsewhere."""
SAID_TRUST = 0.95
"""Probability that a thing is where the person said."""
AFRESH = 0.05
"""The rates are estimated again after this relative increase in the number of facts."""


class Experience:
    """Implements `Experience` of the protocols, from a file of facts."""

    def __init__(
        self, facts: FactStore, classes: Callable[[str], str], now: Callable[[], float]
    ) -> None:
        """Start without any facts.

        Args:
            facts: the facts to learn from.
            classes: returns the class of a thing; empty if it has none.
            now: returns the time (UTC, s).
        """
        self._facts = facts
        self._classes = classes
        self._now = now
        self._seen = Sightings()
        self._last = 0
        self._count = self._learned_of = 0
        self._rates = learned((), classes)

    def learn(self) -> None:
        """Add the new facts; if there are enough of them, estimate the rates again from all."""
        self._catch_up()
        if self._count <= self._learned_of * (1 + AFRESH):
            return
        self._rates = learned(list(self._seen.intervals()), self._classes)
        self._learned_of = self._count

    def recalled(self, name: str) -> tuple[Statement, ...]:
        """What memory and habits say about where a thing is now.

        Empty if its place was never known: by sight, by the robot's own deeds, or from the person.
        """
        self._catch_up()
        followed = self._followed(name)
        if followed is None:
            return ()
        place, stayed, moved = followed
        said = []
        if stayed > 0:
            worth = min(stayed, MOST_TRUSTED)
            said.append(Statement(Source.MEMORY, ((place, 1.0),), worth))
        rest = 1 - (said[0].trust if said else 0.0)
        if total := sum(moved.values()):
            trust = min(total / rest, MOST_TRUSTED)
            said.append(Statement(Source.HABITS, tuple(moved.items()), trust))
        return tuple(one for one in said if one.trust > 0)

    # --- for explanations ---

    def things(self) -> tuple[str, ...]:
        """All things whose place was ever known, in alphabetical order."""
        self._catch_up()
        return tuple(sorted(self._seen.known))

    def belief(self, name: str) -> Belief:
        """Where the thing may be now, from memory and habits alone."""
        return believe(self.recalled(name), ())

    def rates(self) -> Rates:
        """The estimated rates of moves."""
        return self._rates

    # --- following a thing ---

    def _catch_up(self) -> None:
        new, self._last = self._facts.since(self._last, MOST_LEARNED)
        self._count += len(new)
        self._seen.add(new)

    def _followed(self, name: str) -> tuple[str, float, dict[str, float]] | None:
        """Its last place, P(it has stayed there), and for each place P(it was taken there since).

        The rest to 1 is the probability of places where it was never seen.
        """
        known = self._seen.known.get(name)
        if not known:
            return None
        last, now = known[-1], self._now()
        places = [last.place, *self._places_of(name, last.place)]
        chain = _Chain(places, self._rates.among(name, places))
        chain.begin(_share(last), _said_before(known))
        chain.at_s = since_s = max(last.time_s, now - LONGEST_S)
        for time_s, place in self._seen.absences(name, last.time_s):
            if time_s > since_s:
                chain.pass_until(min(time_s, now))
            chain.not_at(place)
        chain.pass_until(now)
        return last.place, float(chain.stayed), chain.moved()

    def _places_of(self, name: str, place: str) -> list[str]:
        others = {known.place: None for known in self._seen.known[name]}
        others |= dict.fromkeys(self._rates.places.get(name, ()))
        return [other for other in others if other != place]


def _share(last: Known) -> float:
    """Probability that the thing was still at its last known place right after that time."""
    return 0.0 if last.taken else SAID_TRUST if last.said else 1.0


def _said_before(known: Sequence[Known]) -> dict[str, float]:
    """Other places that the person named at the same time, with weights relative to the first."""
    others: dict[str, float] = {}
    last = known[-1]
    for one in reversed(known[:-1]):
        if not (last.said and one.said and last.time_s - one.time_s < 1.0):
            break
        others[one.place] = 0.5 ** (len(others) + 1)
    return others


class _Chain:
    """Probability of each place of one thing, over time; index 0 is the last known place."""

    def __init__(self, places: Sequence[str], rate: Floats) -> None:
        """`rate` is (SLOTS, n + 1, n + 1), moves per hour; the last index is any other place."""
        self._places = list(places)
        self._number = {place: number for number, place in enumerate(places)}
        self._away = rate.sum(axis=-1)
        self._to = rate / np.maximum(self._away, HARDLY)[..., None]
        self.stayed = 0.0
        """Probability that the thing is at its last place and was never taken away."""
        self._moved = np.zeros(len(places) + 1)
        self.at_s = 0.0

    def begin(self, share: float, others: Mapping[str, float]) -> None:
        """Start: `share` is split among the first place (weight 1) and the others by their weights.

        The rest is the probability of any other place.
        """
        total = 1 + sum(others.values())
        for place, weight in others.items():
            self._moved[self._number[place]] += share * weight / total
        self.stayed = share / total
        self._moved[-1] += 1 - share

    def pass_until(self, time_s: float) -> None:
        """Advance to this time (UTC, s), with moves at the given rates."""
        while self.at_s < time_s - 1e-6:
            hour = math.floor(self.at_s / HOUR_S + 1e-9)
            step_s = min((hour + 1) * HOUR_S, time_s) - self.at_s
            self._move(int(slots(np.array(hour))), step_s / HOUR_S)
            self.at_s += step_s

    def _move(self, slot: int, length: float) -> None:
        gone = goes(self._away[slot], np.asarray(length))
        leaves = self._moved * gone
        leaves[0] += self.stayed * gone[0]
        self._moved = self._moved * (1 - gone) + leaves @ self._to[slot]
        self.stayed *= 1 - gone[0]

    def not_at(self, place: str) -> None:
        """Update with the evidence that the thing was not seen at a place."""
        number = self._number.get(place)
        if number is None:
            return
        self._moved[number] *= MISSED
        if number == 0:
            self.stayed *= MISSED
        total = self.stayed + self._moved.sum()
        self._moved, self.stayed = self._moved / total, self.stayed / total

    def moved(self) -> dict[str, float]:
        """For each place, the probability that the thing was taken there; without places of 0."""
        named = zip(self._places, self._moved[:-1].tolist(), strict=True)
        return {place: share for place, share in named if share > 0}
