"""Whether probabilities can be trusted: how often what is likely so is so.

A thing of which several places are right is thought to be at one of them, each as likely.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import log
from statistics import fmean

BINS = 10
LEAST = 1e-6
"""What is less likely counts as this, so that one surprise is not everything."""


@dataclass(frozen=True, slots=True)
class Calibration:
    """Of one way of finding out, over the things of a data set.

    Attributes:
        error: the expected calibration error of the place that comes first (Guo et al., "On
            Calibration of Modern Neural Networks", 2017), from 0, which is best, to 1.
        log_score: the mean logarithm of how likely the thing's place was said to be; 0 is best.
        bins: of the first places with like probabilities (a tenth of the scale each): their mean
            probability, how often they were right, and how many they are.
    """

    error: float
    log_score: float
    bins: tuple[tuple[float, float, int], ...]


def calibration(told: Iterable[tuple[Mapping[str, float], Sequence[str]]]) -> Calibration:
    """Of the probabilities of places, each with the places that are right; at least one."""
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
