from itertools import permutations
from math import inf, isfinite

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.plan import Chance, Plan, Prices, best_plan

FINITE = st.floats(0, 500)
PRICES = st.sampled_from([0.0, 5.0, 20.0, 60.0, 180.0, inf])


@st.composite
def searches(draw, least=1, most=5):
    """Places on a floor, how likely each is, and how likely elsewhere."""
    size = draw(st.integers(least, most))
    spot = st.tuples(st.floats(0, 10), st.floats(0, 10))
    points = np.array(draw(st.lists(spot, min_size=size + 1, max_size=size + 1)))
    ways = np.linalg.norm(points[:, None] - points[None], axis=2) / 0.8 + 1.0
    chances = draw(st.lists(st.floats(0.01, 1), min_size=size, max_size=size))
    return chances, ways[0, 1:], ways[1:, 1:], draw(st.sampled_from([0.0, 0.1]))


def plan(search, question_s, visit_s=0.0) -> Plan:
    chances, first, between, elsewhere = search
    named = [Chance(f"place {i}", chance) for i, chance in enumerate(chances)]
    return best_plan(named, first, between, Prices(question_s, visit_s), elsewhere)


def cheapest(search, question_s, visit_s=0.0) -> float:
    """Of all orders and all moments."""
    chances, first, between, elsewhere = search
    chances = np.array(chances) / (sum(chances) + elsewhere)
    costs = []
    for order in permutations(range(len(chances))):
        left, cost, ways = 1.0, 0.0, first
        for at in range(len(order) + 1):
            if isfinite(question_s):
                rest = sum(chances[j] * (ways[j] + visit_s) for j in order[at:])
                costs.append(cost + rest + left * question_s)
            elif at == len(order):
                costs.append(cost)
            if at < len(order):
                cost += left * (ways[order[at]] + visit_s)
                left -= chances[order[at]]
                ways = between[order[at]]
    return min(costs)


@given(searches(), PRICES, st.sampled_from([0.0, 3.0]))
@settings(max_examples=60, deadline=None)
def test_no_order_and_no_moment_to_ask_costs_less(search, question_s, visit_s):
    found = plan(search, question_s, visit_s).expected.cost
    assert found == pytest.approx(cheapest(search, question_s, visit_s), abs=1e-6)


@given(searches(most=9), FINITE, FINITE)
@settings(max_examples=40, deadline=None)
def test_a_dearer_question_is_not_asked_more_and_makes_nothing_cheaper(search, one, another):
    cheap, dear = sorted((one, another))
    less, more = plan(search, cheap).expected, plan(search, dear).expected
    assert more.cost >= less.cost - 1e-6
    assert more.questions <= less.questions + 1e-6


@given(searches(most=16))
@settings(max_examples=40, deadline=None)
def test_what_costs_nothing_is_asked_at_once(search):
    found = plan(search, 0.0)
    assert found.asks
    assert found.order == ()


@given(searches(most=16))
@settings(max_examples=40, deadline=None)
def test_nobody_who_stays_silent_is_asked_and_every_place_is_looked_at(search):
    found = plan(search, inf)
    assert found.ask_after is None
    assert found.asking is None
    assert found.expected.questions == 0
    assert sorted(found.order) == sorted(f"place {i}" for i in range(len(search[0])))


@given(searches(least=2), PRICES)
@settings(max_examples=40, deadline=None)
def test_a_place_without_a_way_is_not_in_the_order(search, question_s):
    chances, first, between, elsewhere = search
    shut = np.where(np.arange(len(first)) == 1, inf, first)
    ways = np.array(between)
    ways[:, 1] = inf
    found = plan((chances, shut, ways, elsewhere), question_s)
    assert "place 1" not in found.order
    assert isfinite(found.expected.cost)


@given(searches(most=16), PRICES)
@settings(max_examples=40, deadline=None)
def test_the_expectation_is_that_of_the_better_of_asking_and_looking(search, question_s):
    found = plan(search, question_s)
    choices = [e.cost for e in (found.asking, found.looking) if e]
    assert found.expected.cost == pytest.approx(min(choices))


def test_one_place_is_looked_at_if_the_way_costs_less_than_to_ask_and_go():
    found = best_plan([Chance("desk", 0.9)], [10.0], [[0.0]], Prices(60.0), elsewhere=0.1)
    assert found.order == ("desk",)
    assert found.expected.cost == pytest.approx(10 + 0.1 * 60)
    assert found.expected.visits == 1


def test_with_nowhere_to_look_the_person_is_asked():
    assert best_plan([], [], [], Prices(60.0)).asks


def test_with_nowhere_to_look_and_nobody_to_ask_it_is_over():
    found = best_plan([], [], [], Prices(inf))
    assert found.is_over
    assert not found.asks


def test_what_lies_on_the_way_is_looked_at_first_though_it_is_less_likely():
    chances = [Chance("far", 0.6), Chance("near", 0.4)]
    ways = [[0.0, 12.0], [10.0, 0.0]]
    assert best_plan(chances, [12.0, 2.0], ways, Prices(inf)).order == ("near", "far")


def test_in_a_large_home_the_plan_is_near_to_the_best(monkeypatch):
    chance = np.random.default_rng(4)
    ratios = []
    for _ in range(6):
        points = chance.uniform(0, 15, (15, 2))
        ways = np.linalg.norm(points[:, None] - points[None], axis=2) / 0.8 + 1.0
        search = (chance.dirichlet([0.5] * 14), ways[0, 1:], ways[1:, 1:], 0.05)
        near = plan(search, inf).expected.cost
        with monkeypatch.context() as patched:
            patched.setattr("executive.plan.EXACT", 14)
            ratios.append(near / plan(search, inf).expected.cost)
    assert np.mean(ratios) < 1.02
