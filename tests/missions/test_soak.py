"""Missions in which everything may go wrong; `benchmarks/bench_soak.py` runs thousands of them."""

import pytest
from soaking.case import missions_of, run_household

MISSIONS = 300
FIRST = 1_000_000
"""Seeds from here on; the benchmark begins at 0."""


def _households() -> list[int]:
    """Seeds of as many households as it takes for the missions."""
    seeds: list[int] = []
    while sum(map(missions_of, seeds)) < MISSIONS:
        seeds.append(FIRST + len(seeds))
    return seeds


@pytest.mark.parametrize("first", range(0, len(_households()), 10))
def test_whatever_goes_wrong_it_tells_the_truth_and_comes_to_rest(first: int) -> None:
    for seed in _households()[first : first + 10]:
        assert run_household(seed) == []
