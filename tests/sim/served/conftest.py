"""The robot that the tests of a file share, in the instant world, and what speaks with it."""

from collections.abc import Iterator

import pytest
from served import Raw, served

from sim.served.simulation import Simulation


@pytest.fixture(scope="module")
def robot() -> Iterator[Simulation]:
    with served() as simulation:
        yield simulation


@pytest.fixture
def client(robot: Simulation) -> Iterator[Raw]:
    with Raw(robot) as raw:
        yield raw
