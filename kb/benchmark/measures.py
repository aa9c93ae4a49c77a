"""Measures for an order of places, given the right ones; Manning et al., ch. 8."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import astuple, dataclass
from math import comb
from statistics import fmean


@dataclass(frozen=True, slots=True)
class Measures:
    """All from 0 to 1, 1 is best.

    Attributes:
        first: whether a right place comes first.
        in_three: whether one is among the first three.
        in_five: whether one is among the first five.
        reciprocal_rank: 1 / rank of the first right place.
        average_precision: mean over the right places of the precision at their rank.
    """

    first: float
    in_three: float
    in_five: float
    reciprocal_rank: float
    average_precision: float


def measure(order: Sequence[str], right: Collection[str]) -> Measures:
    """The measures of one order; a right place that is not in it counts as never found."""
    ranks = [rank for rank, place in enumerate(order, start=1) if place in right]
    best = ranks[0] if ranks else float("inf")
    precisions = [found / rank for found, rank in enumerate(ranks, start=1)]
    return Measures(best <= 1, best <= 3, best <= 5, 1 / best, sum(precisions) / len(right))


def expected_of_chance(places: int, right: int) -> Measures:
    """The exact mean of `measure` over all orders of so many places, `right` of them right."""
    orders = comb(places, right)

    def within(rank: int) -> float:
        return 1 - comb(max(places - rank, 0), right) / orders

    last = places - right + 1
    reciprocal = sum(comb(places - k, right - 1) / orders / k for k in range(1, last + 1))
    harmonic = sum(1 / rank for rank in range(1, places + 1)) / places
    others = (right - 1) / (places - 1) if places > 1 else 0.0
    precision = harmonic + others * (1 - harmonic)
    return Measures(within(1), within(3), within(5), reciprocal, precision)


def mean(measures: Iterable[Measures]) -> Measures:
    """The mean of each measure over at least one object."""
    return Measures(*map(fmean, zip(*map(astuple, measures), strict=True)))
