"""How long ways take, by the map."""

from math import inf

import numpy as np
import pytest

from executive.testing.bench import four_rooms
from sim.navigation.durations import Durations, duration
from sim.navigation.grid import OccupancyGrid


@pytest.fixture(scope="module")
def durations() -> Durations:
    home = four_rooms()
    return Durations(home, OccupancyGrid.from_home(home))


def test_the_way_back_takes_nearly_as_long(durations: Durations) -> None:
    there, back = durations.seconds("person", "desk"), durations.seconds("desk", "person")
    assert there == pytest.approx(back, rel=0.2)


def test_where_one_is_takes_no_time(durations: Durations) -> None:
    assert durations.seconds("desk", "desk") == 0


def test_a_place_that_is_not_there_takes_for_ever(durations: Durations) -> None:
    assert durations.seconds("desk", "moon") == inf
    assert durations.seconds("moon", "desk") == inf


def test_a_metre_more_takes_as_long_as_the_speed_says() -> None:
    four, five = (duration(((0.0, 0.0), (x, 0.0)), 0.0, 0.0) for x in (4.0, 5.0))
    assert five - four == pytest.approx(1 / 0.8, rel=0.02)


def test_a_corner_and_a_turn_at_the_end_take_time() -> None:
    straight = duration(((0.0, 0.0), (3.0, 0.0)), 0.0, 0.0)
    corner = duration(((0.0, 0.0), (1.5, 0.0), (1.5, 1.5)), 0.0, np.pi / 2)
    turned = duration(((0.0, 0.0), (3.0, 0.0)), 0.0, np.pi)
    assert corner > straight + 0.3
    assert turned > straight + 0.3
