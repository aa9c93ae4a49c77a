"""Ways around obstacles, on a plane."""

import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest

from executive.geometry import Floats
from sim.manipulation.rrt import connect

LOWER, UPPER = np.zeros(2), np.full(2, 40.0)
START, GOAL = np.array([5.0, 5.0]), np.array([35.0, 5.0])


def beside_a_wall(point: Floats, top: float = 30.0, graze: float = 0.0) -> bool:
    """A wall at x = 18 to 22 that is open above `top`; so far a point may reach into it."""
    return bool(abs(point[0] - 20.0) > 2.0 - graze or point[1] > top - graze)


def test_where_nothing_is_the_way_is_straight() -> None:
    way = connect(START, GOAL, LOWER, UPPER, lambda point: True, samples=50)
    assert way is not None
    assert np.array_equal(np.array(way), [START, GOAL])


@pytest.mark.parametrize(("start", "goal"), [(START, GOAL), (GOAL, START)])
def test_a_way_leads_around_a_wall_from_start_to_goal(start: Floats, goal: Floats) -> None:
    """Checked once a unit, a straight line can cut a corner by less than half a unit."""
    way = connect(start, goal, LOWER, UPPER, beside_a_wall, samples=500)
    assert way is not None
    assert np.array_equal(way[0], start)
    assert np.array_equal(way[-1], goal)
    for one, other in pairwise(way):
        line = (one + part * (other - one) for part in np.linspace(0, 1, 400))
        assert all(beside_a_wall(point, graze=0.5) for point in line)


def test_there_is_no_way_through_a_closed_wall() -> None:
    closed = connect(START, GOAL, LOWER, UPPER, lambda p: beside_a_wall(p, top=50.0), samples=200)
    assert closed is None


def test_the_same_question_has_the_same_answer() -> None:
    one, other = (connect(START, GOAL, LOWER, UPPER, beside_a_wall, samples=500) for _ in "ab")
    assert np.array_equal(np.array(one), np.array(other))


def test_ompl_is_not_imported_before_a_way_around_is_sought() -> None:
    show = "import sim.world, sys; sys.exit('ompl' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", show]).returncode == 0
