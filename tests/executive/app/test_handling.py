"""Where a robot without skills of its own stands to reach for what it sees."""

import math

import pytest

from executive.app.handling import KnownThings
from executive.testing.bench import four_rooms
from executive.types.geometry import Pose
from executive.types.home import PERSON

NEAR_M = 0.45


@pytest.mark.parametrize("place", ["desk", PERSON])
def test_what_lies_on_the_floor_is_reached_for_around_it_wherever_the_robot_stands(
    place: str,
) -> None:
    home = four_rooms()
    x, y, _ = home.stand(place)
    base, fallen = Pose((x, y, 0.0)), (x + 0.3, y + 0.3, 0.05)
    stances = KnownThings(home).stances(place, fallen, base, NEAR_M)
    assert stances == KnownThings(home).stances(None, fallen, base, NEAR_M)
    assert {round(math.dist(one[:2], fallen[:2]), 3) for one in stances} == {0.55}


def test_what_stands_on_furniture_is_reached_for_from_its_front() -> None:
    home = four_rooms()
    x, y, yaw = home.stand("desk")
    stances = KnownThings(home).stances(
        "desk", home.view_targets("desk")[0], Pose((x, y, 0.0)), NEAR_M
    )
    assert stances[0][2] == pytest.approx(yaw)
