"""Means, intervals and tests for the tables of an experiment.

The commands are the sample of an experiment. Seeds only repeat a command, and a system without
randomness repeats it exactly. So intervals and tests are computed over commands, not over missions.
"""

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import stats

RESAMPLES = 10_000
LEVEL = 0.95

Name = TypeVar("Name", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Summary:
    """Mean, standard deviation and 95 % interval of the mean of a column of numbers."""

    n: int
    groups: int
    """Number of groups for the interval; with a single one, `low` and `high` are equal."""
    mean: float
    sd: float
    """Standard deviation of single missions (n - 1 in the denominator); 0 for a single one."""
    low: float
    high: float


def summarize(groups: Mapping[str, Sequence[float]], seed: int = 0) -> Summary | None:
    """Summarize missions that are grouped by command; None if there are none.

    The interval is a percentile bootstrap that draws commands, each with all its missions.
    """
    filled = [np.asarray(values, float) for values in groups.values() if len(values)]
    if not filled:
        return None
    values = np.concatenate(filled)
    draws = np.random.default_rng(seed).integers(len(filled), size=(RESAMPLES, len(filled)))
    sums, sizes = np.array([g.sum() for g in filled]), np.array([g.size for g in filled])
    means = sums[draws].sum(axis=1) / sizes[draws].sum(axis=1)
    low, high = np.quantile(means, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    sd = float(values.std(ddof=1)) if values.size > 1 else 0.0
    return Summary(values.size, len(filled), float(values.mean()), sd, float(low), float(high))


@dataclass(frozen=True, slots=True)
class Comparison(Generic[Name]):
    """Two conditions compared; `difference` is the mean of `a` - `b` over the pairs."""

    a: Name
    b: Name
    pairs: int
    difference: float
    p: float
    """p value after Holm's correction over all comparisons made together."""


def pairwise(columns: Mapping[Name, Mapping[Hashable, float]]) -> list[Comparison[Name]]:
    """Compare all pairs of conditions, with `compare`."""
    return compare(columns, combinations(columns, 2))


def compare(
    columns: Mapping[Name, Mapping[Hashable, float]], pairs: Iterable[tuple[Name, Name]]
) -> list[Comparison[Name]]:
    """Compare pairs of conditions by Wilcoxon's signed-rank test, with Holm's correction over all.

    Only units that both conditions have are compared.

    Args:
        columns: for each condition, the value of each unit (a command, or a mission).
        pairs: the pairs to compare; those without common units are left out.
    """
    found: list[Comparison[Name]] = []
    for a, b in pairs:
        units = [unit for unit in columns[a] if unit in columns[b]]
        if units:
            d = np.array([columns[a][unit] - columns[b][unit] for unit in units])
            found.append(Comparison(a, b, len(units), float(d.mean()), signed_rank(d)))
    corrected = holm([one.p for one in found])
    return [replace(one, p=p) for one, p in zip(found, corrected, strict=True)]


EXACT_UP_TO = 12
"""Up to this many differing pairs, p is exact; above, by the normal approximation."""


def signed_rank(
    differences: Sequence[float] | NDArray[np.float64],
) -> float:
    """Two-sided p of Wilcoxon's signed-rank test; 1 for fewer than two pairs with a difference.

    Pairs without a difference are left out.
    """
    d = np.asarray(differences, float)
    d = d[np.abs(d) > 1e-12]
    if d.size < 2:
        return 1.0
    if d.size > EXACT_UP_TO:
        return float(stats.wilcoxon(d, method="approx").pvalue)
    every = stats.permutation_test(
        (d,), _ranks_of_positive, permutation_type="samples", n_resamples=2**EXACT_UP_TO
    )
    return float(every.pvalue)


def _ranks_of_positive(d: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """Wilcoxon's statistic along an axis: the sum of the ranks of positive differences."""
    ranks: NDArray[np.float64] = stats.rankdata(np.abs(d), axis=axis)
    return np.asarray(np.where(d > 0, ranks, 0.0).sum(axis=axis), float)


def holm(ps: Sequence[float]) -> list[float]:
    """The p values after Holm's step-down correction for multiple comparisons, in their order."""
    corrected, least = [0.0] * len(ps), 0.0
    for rank, index in enumerate(np.argsort(ps, kind="stable")):
        least = max(least, min(1.0, (len(ps) - rank) * ps[index]))
        corrected[index] = least
    return corrected


def stars(p: float) -> str:
    """Stars as in the paper's figures: ** below 0.01, * below 0.05."""
    return "**" if p < 0.01 else "*" if p < 0.05 else ""


def grouped(pairs: Iterable[tuple[str, float]]) -> dict[str, list[float]]:
    """The values of each name, in order."""
    groups: dict[str, list[float]] = {}
    for name, value in pairs:
        groups.setdefault(name, []).append(value)
    return groups
