"""Where one is on a way of straight pieces."""

import numpy as np
import pytest

from sim.body.way import Way


@pytest.mark.parametrize("seed", range(20))
def test_it_is_where_numpy_has_it_to_the_bit(seed: int) -> None:
    chance = np.random.default_rng(seed)
    points = chance.normal(size=(7, 3))
    along = np.concatenate(([0.0], np.cumsum(chance.uniform(0, 2, 6) * chance.integers(0, 2, 6))))
    lengths = np.concatenate((along, chance.uniform(0.0, along[-1] + 1.0, 100)))
    way = Way(along, points)
    expected = np.column_stack([np.interp(lengths, along, axis) for axis in points.T])
    assert (way.at_each(lengths) == expected).all()
    assert [way.at(float(length)).tolist() for length in lengths] == expected.tolist()
