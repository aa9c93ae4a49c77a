"""How far points are from the surface of things, and which way that grows."""

import numpy as np
import pytest

from sim.objects.distance import distance_to
from sim.objects.objects import load_objects

MODELS = load_objects()
STEP_M = 1e-6


@pytest.mark.parametrize("name", ["apple", "banana", "mug", "pear", "power_drill"])
def test_the_distance_grows_as_its_gradient_says(name: str):
    distance = distance_to(MODELS[name].shapes)
    points = np.random.default_rng(0).uniform(-0.2, 0.2, (3, 2000))
    found, grows = distance.with_gradient(points)
    step = STEP_M * np.eye(3)[:, :, None]
    measured = np.stack([distance.at(points + s) - distance.at(points - s) for s in step])
    off = np.abs(measured / (2 * STEP_M) - grows).max(axis=0)
    assert np.abs(found - distance.at(points)).max() < 1e-6
    assert np.quantile(off, 0.99) < 1e-3  # at edges there is no gradient
