"""Whether probabilities can be trusted: how often a prediction with this probability is right.

If several places of a thing are right, it is assumed to be at one of them, with equal probability.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import log
from statistics import fmean

BINS = 10
LEAST = 1e-6
"""Smaller probabilities count as this, so that one surprise does not dominate."""


@dataclass(frozen=True, slots=True)
class Calibration:
    """The calibration of one method over the things of a data set.

    Attributes:
        error: expected calibration error of the first place (Guo et al., "On Calibration of
            Modern Neural Networks", 2017), from 0 (best) to 1.
        log_score: mean log-probability of the right place; 0 is best.
        bins: the first places, grouped by probability (bins of 0.1): mean probability, share of
            right ones, and number.
    """

    error: float
    log_score: float
    bins: tuple[tuple[float, float, int], ...]


def calibration(told: Iterable[tuple[Mapping[str, float], Sequence[str]]]) -> Calibration:
    """From pairs of predicted probabilities and right places; at least one pair."""
    sorted_in: list[list[tuple[float, float]]] = [[] for _ in range(BINS)]
    scores = []
    for probabilities, right in told:
        share = 1 / len(right)
        scores.append(share * sum(log(max(probabilities.get(p, 0.0), LEAST)) for p in right))
        first = max(probabilities, key=lambda place: probabilities[place])
        chance = probabilities[first]
        bin_of_it = sorted_in[min(int(chance * BINS), BINS - 1)]
        bin_of_it.append((chance, share if first in right else 0.0))
    bins = tuple(
        (fmean(chance for chance, _ in one), fmean(so for _, so in one), len(one))
        for one in sorted_in
        if one
    )
    error = sum(abs(chance - so) * number for chance, so, number in bins) / len(scores)
    return Calibration(error, fmean(scores), bins)
