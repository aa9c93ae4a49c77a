"""Turns facts into a history for each thing: seen here, absent there, unknown in between.

A look at a whole place says something about every thing, whatever was looked for: what was not
seen there is not there. A whole place was looked at if something was looked for there in vain, and
often also where it was found: then a fact of kind LOOKED says so.
"""

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from kb.facts import Fact, FactKind

LOOK_S = 60.0
"""Facts about a place within this time (s) after the first one belong to one look."""
_SEEN = {FactKind.SEEN, FactKind.PUT, FactKind.SAID, FactKind.TAKEN}
"""Facts which say that the thing is, or was until now, at the place."""
_OF_A_LOOK = {FactKind.SEEN, FactKind.MISSED, FactKind.LOOKED}


def _time(look: tuple[float, frozenset[str]]) -> float:
    return look[0]


def _when(absence: tuple[float, str]) -> float:
    return absence[0]


@dataclass(frozen=True, slots=True)
class Known:
    """A time at which the place of a thing was known.

    Attributes:
        time_s: when (UTC, s).
        place: where.
        taken: whether the robot took it away then; the place is unknown from then on.
        said: whether the person said so.
    """

    time_s: float
    place: str
    taken: bool = False
    said: bool = False


@dataclass(frozen=True, slots=True)
class Interval:
    """The time between two moments at which the place of a thing was known.

    Attributes:
        thing: which.
        since_s: the start (UTC, s).
        until_s: the end (UTC, s).
        place: the place at the start.
        at: the place at the end.
        absences: times and places at which it was not seen in between, in order.
    """

    thing: str
    since_s: float
    until_s: float
    place: str
    at: str
    absences: tuple[tuple[float, str], ...] = ()


@dataclass
class _Look:
    """A look at a place; later facts may still be added to it."""

    since_s: float
    seen: set[str] = field(default_factory=set)
    missed: set[str] = field(default_factory=set)
    whole: bool = False
    """Whether the whole place was looked at."""


@dataclass
class Sightings:
    """The history of all things, in the order of the facts."""

    known: dict[str, list[Known]] = field(default_factory=lambda: defaultdict(list))
    """For each thing, when its place was known."""
    looks: dict[str, list[tuple[float, frozenset[str]]]] = field(
        default_factory=lambda: defaultdict(list)
    )
    """For each place, when the whole of it was looked at, and what was there."""
    denied: dict[str, list[tuple[float, str]]] = field(default_factory=lambda: defaultdict(list))
    """For each thing, when the person said that it is not at a place, and which place."""
    _open: dict[str, _Look] = field(default_factory=dict)

    def add(self, facts: Iterable[Fact]) -> None:
        """Add facts, oldest first."""
        for fact in facts:
            self._look(fact)
            if fact.kind == FactKind.DENIED:
                self.denied[fact.object].append((fact.time_s, fact.place))
            if fact.kind in _SEEN:
                taken, said = fact.kind == FactKind.TAKEN, fact.kind == FactKind.SAID
                self.known[fact.object].append(Known(fact.time_s, fact.place, taken, said))

    def _look(self, fact: Fact) -> None:
        if fact.kind not in _OF_A_LOOK:
            return
        look = self._open.get(fact.place)
        if look is None or not 0 <= fact.time_s - look.since_s <= LOOK_S:
            look = self._open[fact.place] = _Look(fact.time_s)
        if fact.kind == FactKind.SEEN:
            look.seen.add(fact.object)
        elif fact.kind == FactKind.MISSED:
            look.missed.add(fact.object)
        look.whole |= fact.kind != FactKind.SEEN
        if look.whole:
            looks = self.looks[fact.place]
            if looks and looks[-1][0] == look.since_s:
                looks.pop()
            looks.append((look.since_s, frozenset(look.seen - look.missed)))

    def intervals(self) -> Iterator[Interval]:
        """The intervals to learn from: none begins when the robot took the thing away."""
        for thing, known in self.known.items():
            absences = self.absences(thing, known[0].time_s)
            for one, after in zip(known, known[1:], strict=False):
                if one.taken or after.time_s <= one.time_s:
                    continue
                first = bisect_right(absences, one.time_s, key=_when)
                last = bisect_right(absences, after.time_s - LOOK_S, key=_when)
                between = tuple(absences[first:last])
                yield Interval(thing, one.time_s, after.time_s, one.place, after.place, between)

    def absences(self, thing: str, since_s: float) -> list[tuple[float, str]]:
        """When and where a thing was not, by looks or the person's words, after a time; sorted."""
        found = [
            (time_s, place)
            for place, looks in self.looks.items()
            for time_s, seen in looks[bisect_right(looks, since_s, key=_time) :]
            if thing not in seen
        ]
        found += [
            (time_s, place) for time_s, place in self.denied.get(thing, ()) if time_s > since_s
        ]
        return sorted(found)
