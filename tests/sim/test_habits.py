from itertools import pairwise
from pathlib import Path

import pytest

from executive.errors import InputError
from executive.events import Inbox
from executive.testing.bench import Notebook, four_rooms
from sim.home.habits import DAY_S, Habits, Move, load_habits, moves, packaged_habits, pieces_of
from sim.home.home_file import load_home
from sim.objects.objects import load_objects
from sim.tools.generation import generate_home
from sim.world import PhysicsWorld

MONDAY_S = 4 * DAY_S
WEEK_S = 7 * DAY_S


def of_a_week(habits: Habits, seed: int = 0) -> list[Move]:
    return list(moves(habits, four_rooms(), MONDAY_S, MONDAY_S + WEEK_S, seed))


def habit(**entry: object) -> Habits:
    return Habits.model_validate({"habits": [{"things": "mug", "to": "desk", **entry}]})


def test_a_week_is_the_same_however_often_somebody_looks() -> None:
    household = load_habits("household", four_rooms())
    times = [MONDAY_S + hour * 3600.0 for hour in range(7 * 24 + 1)]
    hourly = [m for a, b in pairwise(times) for m in moves(household, four_rooms(), a, b, 0)]
    assert hourly == of_a_week(household)
    assert hourly != of_a_week(household, seed=1)


def test_a_habit_keeps_its_days_and_hours() -> None:
    done = of_a_week(habit(days=["tue", "sun"], hours=[7.0, 8.0]))
    assert [int((move.time_s - MONDAY_S) // DAY_S) for move in done] == [1, 6]
    assert all(7 <= move.time_s % DAY_S / 3600 < 8 for move in done)


def test_its_chance_is_how_often_it_is_done() -> None:
    assert not of_a_week(habit(chance=0.0))
    assert len(of_a_week(habit(chance=1.0))) == 7
    some = moves(habit(chance=0.5), four_rooms(), 0.0, 50 * DAY_S, 0)
    assert 15 < len(list(some)) < 35


def test_a_thing_is_always_taken_to_the_same_piece_of_a_kind() -> None:
    done = of_a_week(habit(to="Table"))
    assert len(pieces_of(four_rooms(), "Table")) == 3
    assert len({move.to for move in done}) == 1


def test_what_is_left_anywhere_is_left_at_more_than_one_place() -> None:
    assert len({move.to for move in of_a_week(habit(to="anywhere"))}) > 2


def test_weights_say_how_often_each_place_is_chosen() -> None:
    done = list(moves(habit(to={"desk": 9, "bed": 1}), four_rooms(), 0.0, 50 * DAY_S, 0))
    assert [move.to for move in done].count("desk") > 35


def test_a_habit_with_things_from_one_place_leaves_others_alone() -> None:
    [move, *_] = of_a_week(habit(only_from="delivery"))
    assert move.fits("delivery")
    assert not move.fits("sofa")
    assert not move.fits("")


def test_a_home_left_alone_for_years_has_lived_through_the_last_days() -> None:
    done = list(moves(habit(), four_rooms(), 0.0, 10_000 * DAY_S, 0))
    assert len(done) <= 61


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "habits is missing; see sim/habits/household.toml"),
        ("[[habit]]\n", "there is no key habit; known are habits"),
        ('[[habits]]\nthing = "mug"\nto = "desk"', "no key habits.0.thing; known are things, to"),
        ('[[habits]]\nthings = "mug"', "habits.0.to is missing"),
        ('[[habits]]\nto = "piano"', "habits.0.to: there is no furniture piano; furniture: cab"),
        ('[[habits]]\nthings = "lamp"\nto = "desk"', "things: there is no object lamp .*; it has"),
        ('[[habits]]\nto = "desk"\nonly_from = "x"', "only_from: there is no furniture x"),
        ('[[habits]]\nto = "desk"\nhours = [9.0, 8.0]', "the first hour should be before the"),
        ('[[habits]]\nto = "desk"\nhours = [9.0, 25.0]', "hours.1 is 25.0; .*less than or equal"),
        ('[[habits]]\nto = "desk"\ndays = "monday"', "days.0 is 'monday'; .*'mon', 'tue'"),
        ('[[habits]]\nto = "desk"\nchance = 1.5', "chance is 1.5; .*less than or equal to 1"),
        ("[[habits]]\nto = {desk = 0}", "to.desk is 0; .*greater than 0"),
        ("habits = ", "is not TOML"),
    ],
)
def test_what_is_wrong_in_a_file_is_told_with_what_would_be_right(
    tmp_path: Path, text: str, sentence: str
) -> None:
    file = tmp_path / "habits.toml"
    file.write_text(text)
    with pytest.raises(InputError, match=sentence):
        load_habits(str(file), four_rooms())


def test_habits_of_no_such_name_are_told_with_those_there_are() -> None:
    with pytest.raises(InputError, match="packaged are household"):
        load_habits("monks", four_rooms())


@pytest.mark.parametrize("name", packaged_habits())
def test_packaged_habits_fit_to_any_home(name: str, tmp_path: Path) -> None:
    file = tmp_path / "home_24.toml"
    file.write_text(generate_home(4, 24, 1))
    home = load_home(str(file))
    assert list(moves(load_habits(name, home), home, MONDAY_S, MONDAY_S + DAY_S, 0))


def test_a_kind_that_the_home_lacks_is_left_out() -> None:
    assert not of_a_week(habit(to="Dresser"))
    assert {move.to for move in of_a_week(habit(to=["Dresser", "bed"]))} == {"bed"}


@pytest.mark.physics
@pytest.mark.parametrize("before_s", [0, 4])
def test_in_physics_a_thing_that_is_taken_elsewhere_stands_there(before_s: int) -> None:
    world = PhysicsWorld(four_rooms(), load_objects(), Inbox(), Notebook(), camera_hz=0.0)
    try:
        for _ in range(before_s * 240):  # everything falls asleep
            world._client.stepSimulation()
        assert world.put("mug", "desk")
        assert world.resting_place("mug") == "desk"
        assert world.left()["mug"].furniture == "desk"
        assert world.left()["mug"].at
    finally:
        world.close()
