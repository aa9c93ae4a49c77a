"""Every condition stands equally often everywhere, and follows every other one equally often."""

from collections import Counter
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.page.study.order import balanced, rotated, rows

COUNTS = range(1, 13)


@pytest.mark.parametrize("count", COUNTS)
def test_each_order_has_each_condition_once(count: int) -> None:
    assert all(sorted(row) == list(range(count)) for row in rows(count))
    assert len(rows(count)) == (2 * count if count % 2 and count > 1 else count)


@pytest.mark.parametrize("count", COUNTS)
def test_each_condition_stands_equally_often_at_each_place(count: int) -> None:
    for place in zip(*rows(count), strict=True):
        assert len(set(Counter(place).values())) == 1


@pytest.mark.parametrize("count", COUNTS)
def test_each_condition_comes_equally_often_right_after_each_other_one(count: int) -> None:
    pairs = Counter(pair for row in rows(count) for pair in pairwise(row))
    assert len(pairs) == count * (count - 1)
    assert len(set(pairs.values())) <= 1


@given(st.integers(1, 12), st.integers(1, 500))
def test_participants_take_the_orders_in_turn(count: int, number: int) -> None:
    conditions, orders = list(range(count)), rows(count)
    assert balanced(conditions, number) == balanced(conditions, number + len(orders))
    assert {balanced(conditions, number + k) for k in range(len(orders))} == set(orders)


def test_tasks_that_rotate_begin_later_each_time() -> None:
    assert [rotated("abc", by) for by in range(4)] == [
        ("a", "b", "c"),
        ("b", "c", "a"),
        ("c", "a", "b"),
        ("a", "b", "c"),
    ]
