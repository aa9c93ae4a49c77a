"""Where a thing may be: one belief over the places of a home, with who says how much of it.

The sources are heard in the order of how far they are to be believed. Each takes its part of what
those before it have left, and spreads it over the places that it names; a source that says
something of every place takes all. What is left at the end is spread evenly.

Pure functions of numbers: nothing of robots, trees or clocks.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

ELSEWHERE = 0.05
"""How likely a thing is at no place that the robot may look at, as long as nobody said where."""
MISSED = 0.02
"""How often a thing is overlooked that is in view: docs/detector.md has a recall of 0.978."""
ANYWHERE = "anywhere"
"""Who says so of what nobody says: a thing has to be somewhere."""
PLAN = "plan"
"""Who says where to look next, by all that is believed and by the ways."""


@dataclass(frozen=True, slots=True)
class Statement:
    """What one source says.

    Attributes:
        source: who.
        weights: the places that it names, with how likely they are beside one another.
        trust: how likely it is right that the thing is at one of them; 1: it says something of all.
        orders: whether its weights alone say which of its places is likeliest. If not, they are
            multiplied by those of a source that says something of every place.
    """

    source: str
    weights: tuple[tuple[str, float], ...]
    trust: float
    orders: bool = True

    def of(self, has: Callable[[str], bool]) -> Self:
        """What it says of some places only; the rest of its word is left to other sources."""
        weights = tuple((place, weight) for place, weight in self.weights if has(place))
        part = _total(weights) / _total(self.weights) if _total(weights) > 0 else 0.0
        return replace(self, weights=weights, trust=self.trust * part)


@dataclass(frozen=True, slots=True)
class Share:
    """How much of a place's probability a source gave."""

    source: str
    probability: float


@dataclass(frozen=True, slots=True)
class Likely:
    """A place, how likely the thing is there, and who says so: the one who gave most first."""

    place: str
    probability: float
    shares: tuple[Share, ...] = ()

    @property
    def source(self) -> str:
        """Who gave most of it."""
        return self.shares[0].source if self.shares else ANYWHERE

    def __str__(self) -> str:
        """The place, its probability, and what each source gave."""
        said = ", ".join(f"{s.source} {s.probability:.2f}" for s in self.shares)
        return f"{self.place} {self.probability:.2f}" + (f" ({said})" if said else "")


@dataclass(frozen=True, slots=True)
class Belief:
    """How likely a thing is at each place, the likeliest first, and elsewhere: all sum to 1."""

    places: tuple[Likely, ...] = ()
    elsewhere: float = 1.0

    def of(self, place: str) -> Likely:
        """What is believed of a place; nothing, if it is none of these."""
        return next((likely for likely in self.places if likely.place == place), Likely(place, 0.0))


def in_order(places: Iterable[str], factor: float = 0.5) -> tuple[tuple[str, float], ...]:
    """Weights of places that a source names in an order: each has `factor` of the one before."""
    return tuple((place, factor**rank) for rank, place in enumerate(dict.fromkeys(places)))


def believe(
    statements: Sequence[Statement],
    places: Iterable[str],
    left: Mapping[str, float] | None = None,
    elsewhere: float = ELSEWHERE,
) -> Belief:
    """The belief that follows from what was said and seen.

    Args:
        statements: the most trusted first. Of those that say something of every place, the first
            counts.
        places: where a thing may be at all; those that a statement names are, too.
        left: of places that were looked at in vain, what is left of their probability: how likely
            the look was to miss the thing. Who says so is believed less from then on.
        elsewhere: what is left for no place at all, of what no statement before took.
    """
    home = tuple(dict.fromkeys(places))
    given: dict[str, dict[str, float]] = {place: {} for place in home}
    rest = 1.0
    of_all = next((t for t in statements if t.trust >= 1 and _total(t.weights) > 0), None)
    base = dict(of_all.weights) if of_all else dict.fromkeys(home, 1.0)
    for said in statements:
        if said.trust < 1 and (weights := _meant(said, base)):
            _give(given, said.source, weights, rest * said.trust)
            rest *= 1 - said.trust
    nowhere = rest * elsewhere if base else rest
    _give(given, of_all.source if of_all else ANYWHERE, base, rest - nowhere)
    return _normalised(given, nowhere, left or {})


def _meant(said: Statement, base: Mapping[str, float]) -> dict[str, float]:
    """The weights of a statement, times those of who says something of every place if need be."""
    weights = {place: weight for place, weight in said.weights if weight > 0}
    if said.orders:
        return weights
    known = {place: weight * base.get(place, 0.0) for place, weight in weights.items()}
    return known if sum(known.values()) > 0 else weights


def _total(weights: Iterable[tuple[str, float]]) -> float:
    return sum(weight for _, weight in weights)


def _give(
    given: dict[str, dict[str, float]], source: str, weights: Mapping[str, float], mass: float
) -> None:
    total = sum(weights.values())
    for place, weight in weights.items():
        shares = given.setdefault(place, {})
        shares[source] = shares.get(source, 0.0) + mass * weight / total


def _normalised(
    given: Mapping[str, Mapping[str, float]], nowhere: float, left: Mapping[str, float]
) -> Belief:
    kept = {
        place: {source: mass * left.get(place, 1.0) for source, mass in shares.items()}
        for place, shares in given.items()
    }
    total = nowhere + sum(sum(shares.values()) for shares in kept.values())
    if total <= 0:
        return Belief(tuple(Likely(place, 0.0) for place in given))
    found = (_likely(place, shares, total) for place, shares in kept.items())
    return Belief(tuple(sorted(found, key=lambda one: -one.probability)), nowhere / total)


def _likely(place: str, shares: Mapping[str, float], total: float) -> Likely:
    most_first = sorted(shares.items(), key=lambda item: -item[1])
    said = tuple(Share(source, mass / total) for source, mass in most_first if mass > 0)
    return Likely(place, sum(shares.values()) / total, said)
