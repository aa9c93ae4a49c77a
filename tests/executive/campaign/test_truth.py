"""What truly came of a mission, and how far the robot had to drive for it."""

from dataclasses import replace
from itertools import pairwise
from math import dist, inf

import pytest

from executive.campaign.journal import Row
from executive.campaign.observer import Observed
from executive.campaign.routes import Routes
from executive.campaign.truth import completed, shortest_m, whereabouts
from executive.testing.bench import four_rooms, run_mission
from executive.types.commands import CommandKind
from executive.types.goals import Pick, PutDown
from logs.recorder import Stamp
from sim.navigation.grid import OccupancyGrid, plan


@pytest.mark.parametrize(
    ("words", "truth"),
    [("Find an apple", "dining_table"), ("Take an apple", "hand"), ("Bring an apple", "delivery")],
)
def test_what_was_done_is_completed_where_each_command_wants_the_thing(
    words: str, truth: str
) -> None:
    run = run_mission(words, llm=False)
    assert whereabouts("apple", run.world) == truth
    assert completed(run.outcome, lambda name: truth)
    assert not completed(run.outcome, lambda name: "bed")
    assert not completed(run.outcome, lambda name: "")


def test_what_is_found_in_the_hand_is_found() -> None:
    outcome = replace(run_mission("Find an apple", llm=False).outcome, location=None, visited=())
    assert completed(outcome, lambda name: "hand")
    assert not completed(outcome, lambda name: "dining_table")


def test_a_robot_that_only_says_so_has_completed_nothing() -> None:
    run = run_mission("Find an apple", llm=False)
    assert not completed(replace(run.outcome, location="sofa"), lambda name: "dining_table")
    assert not completed(replace(run.outcome, visited=("sofa",)), lambda name: "dining_table")


@pytest.mark.parametrize(("truth", "done"), [("sofa", True), ("hand", False), ("", False)])
def test_what_was_put_down_is_on_some_furniture(truth: str, done: bool) -> None:
    outcome = replace(run_mission("Find an apple", llm=False).outcome, kind=CommandKind.PUT_DOWN)
    assert completed(outcome, lambda name: truth) == done


@pytest.mark.parametrize("kind", [Pick, PutDown])
def test_a_robot_that_says_that_it_failed_has_completed_nothing(kind: type) -> None:
    fault = lambda goal: "the hand is stuck" if isinstance(goal, kind) else None  # noqa: E731
    run = run_mission("Bring an apple", llm=False, fault=fault)
    assert not completed(run.outcome, lambda name: "delivery")


def test_the_nearest_is_that_with_the_shortest_way_wherever_the_robot_is() -> None:
    routes, names = Routes(four_rooms()), [place.name for place in four_rooms().places()]
    for start in map(routes.stand, ("person", *names)):
        others = [name for name in names if routes.stand(name) != start]
        shortest = min(others, key=lambda name: routes.length(start, routes.stand(name)))
        assert routes.nearest(start, others) == shortest


def test_the_shortest_way_leads_through_doors_and_is_the_same_back() -> None:
    routes = Routes(four_rooms())
    bed, wagon = routes.stand("bed"), routes.stand("counter_wagon")
    assert routes.length(bed, wagon) > dist(bed, wagon)
    assert routes.length(bed, wagon) == pytest.approx(routes.length(wagon, bed), rel=0.05)
    assert routes.length(bed, (-5.0, 0.0)) == inf


def test_the_shortest_way_is_no_longer_than_the_comfortable_one() -> None:
    routes, comfortable = Routes(four_rooms()), OccupancyGrid.from_home(four_rooms())
    start = four_rooms().robot_start[:2]
    saved = []
    for place in four_rooms().places():
        way = plan(comfortable, start, routes.stand(place.name))
        length = sum(dist(a, b) for a, b in pairwise(way))
        saved.append(length - routes.length(start, routes.stand(place.name)))
    assert min(saved) > -0.02
    assert max(saved) > 0.05


def test_how_far_it_has_to_drive_depends_on_where_the_command_ends() -> None:
    routes = Routes(four_rooms())
    outcome = run_mission("Take an apple", llm=False).outcome
    take, find, bring = (
        shortest_m(replace(outcome, kind=kind), four_rooms(), routes)
        for kind in (CommandKind.TAKE, CommandKind.FIND, CommandKind.BRING)
    )
    table, person = routes.stand("dining_table"), routes.stand("person")
    assert find == pytest.approx(take + routes.length(table, person))
    assert bring == pytest.approx(take + routes.length(table, routes.stand("delivery")))
    assert shortest_m(replace(outcome, object=None), four_rooms(), routes) == 0.0


@pytest.mark.parametrize(
    ("done", "path_m", "spl"), [(True, 4.0, 1.0), (True, 8.0, 0.5), (True, 3.9, 1.0), (False, 4, 0)]
)
def test_spl_is_the_share_of_the_way_that_was_needed(done: bool, path_m: float, spl: float) -> None:
    row = Row("ours", "home", "none", "okb", True, 0, "", 0, completed=done)
    assert replace(row, path_m=path_m, shortest_m=4.0).spl == spl


def test_the_time_of_a_deed_is_counted_by_what_the_innermost_behaviour_declares() -> None:
    observed = Observed()
    for second, record in enumerate(run_mission("Take an apple", llm=False).notebook.records):
        observed.write(Stamp(second, 0), record)
    assert {"driving", "looking", "handling"} <= set(observed.seconds)
    assert "searching" not in observed.seconds
