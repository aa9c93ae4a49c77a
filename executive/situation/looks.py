"""What came of going to places to look for a thing: only what was seen is known."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from executive.language.wording import Wording, either, listed
from executive.situation.snapshot import NOT_LOGGED

T = TypeVar("T")


@dataclass
class Looks:
    """The one account of a search: where the robot got to, what it saw there, and why it did not.

    Attributes:
        visited: places that the robot got to, in this order.
        unreached: places that it could not get to the last time, and why.
        unseen: places of which it could not see every part the last time, and why.
        missed: the place that it could not get to just now, while nobody was told so; else empty.
    """

    visited: list[str] = field(default_factory=list)
    unreached: dict[str, str] = field(default_factory=dict)
    unseen: dict[str, str] = field(default_factory=dict)
    missed: str = field(default="", metadata=NOT_LOGGED)
    _parts: dict[str, int] = field(default_factory=dict, metadata=NOT_LOGGED)
    """How many parts a place has, each of which takes a look of its own."""
    _without: dict[str, set[int]] = field(default_factory=dict, metadata=NOT_LOGGED)
    """The parts of a place in which the thing surely was not, at the last look."""

    def reached(self, place: str) -> None:
        """The robot got there."""
        self.visited.append(place)
        self.unreached.pop(place, None)
        self.missed = ""

    def not_reached(self, place: str, why: str) -> None:
        """The robot could not get there."""
        self.unreached[place] = why
        self.missed = place

    def begin(self, place: str, parts: int) -> None:
        """A look over the whole place begins, of so many parts; the one before counts no more."""
        self._parts[place] = parts
        self._without[place] = set()
        self.unseen.pop(place, None)

    def without(self, place: str, part: int) -> None:
        """This part was seen, and the thing is not there."""
        self._without.setdefault(place, set()).add(part)

    def not_seen(self, place: str, why: str) -> None:
        """A part could not be looked at."""
        self.unseen[place] = why

    def all_without(self, place: str) -> bool:
        """Whether every part of a place was seen, and the thing is in none of them."""
        return 0 < self._parts.get(place, 0) == len(self._without.get(place, ()))

    def failed(self, place: str) -> bool:
        """Whether it was tried to look at a place, and is not known to be without the thing."""
        return place in self.unreached or (place in self.visited and not self.all_without(place))

    def all_but(self, place: str, part: int) -> bool:
        """Whether every other part of a place was seen, and the thing is in none of them."""
        without = self._without.get(place, set())
        return 0 < self._parts.get(place, 0) == len(without | {part})

    def share_seen(self, place: str) -> float:
        """How much of a place was seen without the thing, from 0 to 1."""
        parts = self._parts.get(place, 0)
        return len(self._without.get(place, ())) / parts if parts else 0.0

    def why_not(self, thing: str, place: str, say: Wording) -> str:
        """Why it is not known whether the thing is at a place, as a clause."""
        return _clause(self._failure(place), [place], thing, say)

    def clauses(self, thing: str, say: Wording) -> Iterator[str]:
        """What the search came to: a clause for what was seen, and one for each failure."""
        there = [p for p in dict.fromkeys(self.visited) if p not in self.unreached]
        if seen := [place for place in there if self.all_without(place)]:
            yield f"I did not find {say.the(thing)} {either(say.at_each(seen))}"
        others = (p for p in there if not self.all_without(p))
        failures = {place: self._failure(place) for place in (*others, *self.unreached)}
        for failure, places in alike(failures).items():
            yield _clause(failure, places, thing, say)

    def _failure(self, place: str) -> tuple[str, str]:
        """What became of looking at a place, and why; both empty if that is not known."""
        if why := self.unreached.get(place):
            return "could not get to", why
        if place not in self.unseen:
            return "", ""
        some = "saw only a part of" if self._without.get(place) else "could not look at"
        return some, self.unseen[place]


def alike(places: Mapping[str, T]) -> dict[T, list[str]]:
    """The places of which the same is to be told, together."""
    together: dict[T, list[str]] = {}
    for place, what in places.items():
        together.setdefault(what, []).append(place)
    return together


def _clause(failure: tuple[str, str], places: list[str], thing: str, say: Wording) -> str:
    failed, why = failure
    if not failed:
        return f"I am not sure whether {say.are(thing)} {either(say.at_each(places))}"
    return f"I {failed} {listed([say.the(place) for place in places])}: {why}"
