"""What facts say of each thing one after the other: seen here, gone from there, unknown between.

A place that was looked at all over tells of every thing, whatever was looked for: what was not seen
there is not there. So it is where something was looked for in vain, and often where it was found.
"""

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from kb.facts import Fact, FactKind

LOOK_S = 60.0
"""Facts about one place within this time are of one look."""
_SEEN = {FactKind.SEEN, FactKind.PUT, FactKind.SAID, FactKind.TAKEN}
"""What says that the thing is, or was until now, at the place."""
_OF_A_LOOK = {FactKind.SEEN, FactKind.MISSED, FactKind.LOOKED}


def _time(look: tuple[float, frozenset[str]]) -> float:
    return look[0]


def _when(absence: tuple[float, str]) -> float:
    return absence[0]


@dataclass(frozen=True, slots=True)
class Known:
    """The thing was at a place.

    Attributes:
        time_s: when (UTC, s).
        place: where.
        taken: whether the robot took it from there: nobody knows since.
        said: whether the person said so.
    """

    time_s: float
    place: str
    taken: bool = False
    said: bool = False


@dataclass(frozen=True, slots=True)
class Interval:
    """From one time at which it was known where a thing is to the next one.

    Attributes:
        thing: which.
        since_s: when it was at `place` for sure.
        until_s: when it was seen again.
        place: where it was.
        at: where it was then.
        absences: when and where it was not in between, in order.
    """

    thing: str
    since_s: float
    until_s: float
    place: str
    at: str
    absences: tuple[tuple[float, str], ...] = ()


@dataclass
class _Look:
    """A look at a place that may go on: facts that come soon after belong to it."""

    since_s: float
    seen: set[str] = field(default_factory=set)
    missed: set[str] = field(default_factory=set)
    whole: bool = False
    """Whether all of the place was looked at."""


@dataclass
class Sightings:
    """All of it, in the order of the facts."""

    known: dict[str, list[Known]] = field(default_factory=lambda: defaultdict(list))
    """Of each thing, when it was known where it is."""
    looks: dict[str, list[tuple[float, frozenset[str]]]] = field(
        default_factory=lambda: defaultdict(list)
    )
    """Of each place, when it was looked at all over, and what was there."""
    denied: dict[str, list[tuple[float, str]]] = field(default_factory=lambda: defaultdict(list))
    """Of each thing, when the person said of which place that it is not there."""
    _open: dict[str, _Look] = field(default_factory=dict)

    def add(self, facts: Iterable[Fact]) -> None:
        """Take in the facts, the oldest first."""
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
        """What can be learned from: the times between two sightings of a thing."""
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
        """When and where a thing was not, after a time; in order."""
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
