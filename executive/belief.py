"""Where a thing may be: a probability distribution over places, with the share of each source.

Sources are applied in order of trust. Each takes its share of the probability that the sources
before it have left, and spreads it over the places that it names; a source that covers every place
takes all. What is left at the end is spread evenly.

Pure functions of numbers, independent of robots, trees and clocks.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

ELSEWHERE = 0.05
"""Probability that a thing is at no known place, as long as no source has said where it is."""
MISSED = 0.02
"""Probability that a thing in view is not detected: docs/detector.md has a recall of 0.978."""
ANYWHERE = "anywhere"
"""The source of the probability that no source has assigned."""
PLAN = "plan"
"""The source of a place that the plan chose, from the belief and the drives."""


@dataclass(frozen=True, slots=True)
class Statement:
    """What one source says about where a thing is.

    Attributes:
        weights: the places that it names, with relative probabilities.
        trust: probability that the thing is at one of them; 1: the source covers every place.
        orders: whether its weights alone rank its places. If not, they are multiplied by those of
            the source that covers every place.
    """

    source: str
    weights: tuple[tuple[str, float], ...]
    trust: float
    orders: bool = True

    def of(self, has: Callable[[str], bool]) -> Self:
        """The statement about some of its places only, with its trust reduced accordingly."""
        weights = tuple((place, weight) for place, weight in self.weights if has(place))
        part = _total(weights) / _total(self.weights) if _total(weights) > 0 else 0.0
        return replace(self, weights=weights, trust=self.trust * part)


@dataclass(frozen=True, slots=True)
class Share:
    """The part of a place's probability that comes from one source."""

    source: str
    probability: float


@dataclass(frozen=True, slots=True)
class Likely:
    """A place, the probability that the thing is there, and its shares, the largest first."""

    place: str
    probability: float
    shares: tuple[Share, ...] = ()

    @property
    def source(self) -> str:
        """The source of the largest share."""
        return self.shares[0].source if self.shares else ANYWHERE

    def __str__(self) -> str:
        """The place, its probability and its shares."""
        said = ", ".join(f"{s.source} {s.probability:.2f}" for s in self.shares)
        return f"{self.place} {self.probability:.2f}" + (f" ({said})" if said else "")


@dataclass(frozen=True, slots=True)
class Belief:
    """Probability of a thing at each place, the likeliest first, and elsewhere; the sum is 1."""

    places: tuple[Likely, ...] = ()
    elsewhere: float = 1.0

    def of(self, place: str) -> Likely:
        """The entry of a place; with probability 0 if the belief has none."""
        return next((likely for likely in self.places if likely.place == place), Likely(place, 0.0))


def in_order(places: Iterable[str], factor: float = 0.5) -> tuple[tuple[str, float], ...]:
    """Weights for places in order: each has `factor` times the weight of the one before."""
    return tuple((place, factor**rank) for rank, place in enumerate(dict.fromkeys(places)))


def believe(
    statements: Sequence[Statement],
    places: Iterable[str],
    left: Mapping[str, float] | None = None,
    elsewhere: float = ELSEWHERE,
) -> Belief:
    """Compute the belief from statements and looks.

    Args:
        statements: the most trusted first. Of those that cover every place, only the first counts.
        places: where a thing may be at all, besides the places in statements.
        left: for places where a look found nothing, the probability that the look missed the
            thing. It multiplies the place's probability, so that its sources lose weight.
        elsewhere: the share for no place at all, of what the statements have left.
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
    """The weights of a statement, multiplied by `base` if they do not rank their places."""
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
