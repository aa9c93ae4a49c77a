import math
from itertools import pairwise, permutations

import numpy as np
import pytest

from executive.types.home import DELIVERY, PERSON
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.navigation.grid import FOOTPRINT_M, OccupancyGrid, Unreachable, plan

HOME = load_home("four_rooms")
GRID = OccupancyGrid.from_home(HOME)
STANDS = {
    name: HOME.stand(name)[:2]
    for name in (*(place.name for place in HOME.places()), PERSON, DELIVERY)
} | {"start": HOME.robot_start[:2]}


def nearest_obstacle(home: Home, point: tuple[float, float]) -> float:
    """Distance to walls and furniture, computed from their corners and not from the grid."""
    pieces = [piece.corners() for piece in (*home.furniture, home.delivery)]
    for wall in home.walls():
        (x, y), (a, b) = wall.center, (wall.size[0] / 2, wall.size[1] / 2)
        pieces.append(((x + a, y + b), (x - a, y + b), (x - a, y - b), (x + a, y - b)))
    return min(
        distance_to_segment(point, start, end)
        for corners in pieces
        for start, end in zip(corners, (*corners[1:], corners[0]), strict=True)
    )


def distance_to_segment(point, start, end) -> float:
    p, a, b = (np.asarray(v, dtype=float) for v in (point, start, end))
    share = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return math.dist(p, a + share * (b - a))


def along(path):
    for start, end in pairwise(path):
        for share in np.linspace(0, 1, 2 + int(math.dist(start, end) / 0.05)):
            yield tuple(np.asarray(start) * (1 - share) + np.asarray(end) * share)


def test_every_place_can_be_reached_from_every_other():
    for start, goal in permutations(STANDS.values(), 2):
        path = plan(GRID, start, goal)
        assert path[0] == start
        assert path[-1] == goal


@pytest.mark.parametrize("goal", sorted(STANDS.keys() - {"start"}))
def test_no_path_is_nearer_to_an_obstacle_than_the_footprint(goal: str):
    path = plan(GRID, STANDS["start"], STANDS[goal])
    assert min(nearest_obstacle(HOME, point) for point in along(path)) >= FOOTPRINT_M


def test_a_path_through_a_door_keeps_to_its_middle():
    path = plan(GRID, STANDS["sideboard"], STANDS["bookshelf_bedroom"])
    at_the_wall = min(along(path), key=lambda point: abs(point[0] - 4.2))
    assert at_the_wall[1] == pytest.approx(2.2, abs=0.1)


def test_a_way_across_an_empty_room_is_straight():
    assert plan(GRID, (1.5, 5.5), (2.5, 5.5)) == ((1.5, 5.5), (2.5, 5.5))


def test_a_robot_too_close_to_something_first_moves_away():
    close = (1.15, 7.35 - FOOTPRINT_M - 0.02)
    path = plan(GRID, close, STANDS["high_table"])
    assert path[0] == close
    assert nearest_obstacle(HOME, path[1]) >= FOOTPRINT_M


def test_a_room_whose_doors_are_shut_cannot_be_reached():
    shut = HOME.model_copy(update={"doors": HOME.doors[:1]})
    with pytest.raises(Unreachable, match="is blocked"):
        plan(OccupancyGrid.from_home(shut), STANDS["start"], STANDS["bed"])


def test_a_door_narrower_than_the_robot_is_no_way():
    narrow = tuple(door.model_copy(update={"width": 0.64}) for door in HOME.doors)
    grid = OccupancyGrid.from_home(HOME.model_copy(update={"doors": narrow}))
    with pytest.raises(Unreachable, match="is blocked"):
        plan(grid, STANDS["start"], STANDS["bed"])


@pytest.mark.parametrize("goal", [HOME.furniture[0].pose[:2], (4.2, 7.0), (-3.0, 1.0)])
def test_nobody_can_stand_in_furniture_in_a_wall_or_outside(goal):
    with pytest.raises(Unreachable, match="no room to stand"):
        plan(GRID, STANDS["start"], goal)


def test_a_robot_inside_an_obstacle_is_stuck():
    with pytest.raises(Unreachable, match="stuck"):
        plan(GRID, HOME.furniture[0].pose[:2], STANDS["desk"])
