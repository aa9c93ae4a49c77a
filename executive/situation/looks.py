"""The results of looking for a thing at places: which parts of which place were seen."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from executive.language.wording import Wording, either, listed
from executive.situation.snapshot import NOT_LOGGED

T = TypeVar("T")


@dataclass
class Looks:
    """The results of a search so far, place by place.

    Attributes:
        visited: places that the robot reached, in order.
        unreached: places that it could not reach at the last try, and why.
        unseen: places of which it could not see all parts at the last try, and why.
        missed: the place that it just could not reach, until the person is told so; else empty.
    """

    visited: list[str] = field(default_factory=list)
    unreached: dict[str, str] = field(default_factory=dict)
    unseen: dict[str, str] = field(default_factory=dict)
    missed: str = field(default="", metadata=NOT_LOGGED)
    _parts: dict[str, int] = field(default_factory=dict, metadata=NOT_LOGGED)
    """The number of parts of a place; each part needs a head pose of its own."""
    _without: dict[str, set[int]] = field(default_factory=dict, metadata=NOT_LOGGED)
    """The parts of a place that were seen without the thing, at the last look."""

    def reached(self, place: str) -> None:
        """The robot reached the place."""
        self.visited.append(place)
        self.unreached.pop(place, None)
        self.missed = ""

    def not_reached(self, place: str, why: str) -> None:
        """The robot could not reach the place."""
        self.unreached[place] = why
        self.missed = place

    def begin(self, place: str, parts: int) -> None:
        """Begin to look over a place of this many parts, and forget the look before."""
        self._parts[place] = parts
        self._without[place] = set()
        self.unseen.pop(place, None)

    def without(self, place: str, part: int) -> None:
        """The thing is not in this part of the place."""
        self._without.setdefault(place, set()).add(part)

    def not_seen(self, place: str, why: str) -> None:
        """A part of the place could not be looked at."""
        self.unseen[place] = why

    def all_without(self, place: str) -> bool:
        """Whether all parts of a place were seen without the thing."""
        return 0 < self._parts.get(place, 0) == len(self._without.get(place, ()))

    def failed(self, place: str) -> bool:
        """Whether the robot tried to look at a place, and the thing may still be there."""
        return place in self.unreached or (place in self.visited and not self.all_without(place))

    def all_but(self, place: str, part: int) -> bool:
        """Whether all parts of a place but this one were seen without the thing."""
        without = self._without.get(place, set())
        return 0 < self._parts.get(place, 0) == len(without | {part})

    def share_seen(self, place: str) -> float:
        """The share of a place that was seen without the thing, in [0, 1]."""
        parts = self._parts.get(place, 0)
        return len(self._without.get(place, ())) / parts if parts else 0.0

    def why_not(self, thing: str, place: str, say: Wording) -> str:
        """Why it is unknown whether the thing is at a place, as a clause."""
        return _clause(self._failure(place), [place], thing, say)

    def clauses(self, thing: str, say: Wording) -> Iterator[str]:
        """The results as clauses: one for what was seen, and one for each kind of failure."""
        there = [p for p in dict.fromkeys(self.visited) if p not in self.unreached]
        if seen := [place for place in there if self.all_without(place)]:
            yield f"I did not find {say.the(thing)} {either(say.at_each(seen))}"
        others = (p for p in there if not self.all_without(p))
        failures = {place: self._failure(place) for place in (*others, *self.unreached)}
        for failure, places in alike(failures).items():
            yield _clause(failure, places, thing, say)

    def _failure(self, place: str) -> tuple[str, str]:
        """What failed when looking at a place, and why; both empty if that is not known."""
        if why := self.unreached.get(place):
            return "could not get to", why
        if place not in self.unseen:
            return "", ""
        some = "saw only a part of" if self._without.get(place) else "could not look at"
        return some, self.unseen[place]


def alike(places: Mapping[str, T]) -> dict[T, list[str]]:
    """Group the places that have the same value."""
    together: dict[T, list[str]] = {}
    for place, what in places.items():
        together.setdefault(what, []).append(place)
    return together


def _clause(failure: tuple[str, str], places: list[str], thing: str, say: Wording) -> str:
    failed, why = failure
    if not failed:
        return f"I am not sure whether {say.are(thing)} {either(say.at_each(places))}"
    return f"I {failed} {listed([say.the(place) for place in places])}: {why}"
