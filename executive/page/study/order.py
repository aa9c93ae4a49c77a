"""In which order a participant meets the conditions.

Every condition stands equally often at every place, and before every other one: a Latin square
that is balanced for carry-over (Williams, "Experimental designs balanced for the estimation of
residual effects of treatments", 1949). An odd number of conditions takes two squares for that.
"""

from collections.abc import Sequence
from typing import TypeVar

T = TypeVar("T")


def rows(count: int) -> tuple[tuple[int, ...], ...]:
    """The orders of so many conditions, by number; participants take them in turn."""
    first = [(place + 1) // 2 if place % 2 else -(place // 2) for place in range(count)]
    square = [tuple((shift + one) % count for one in first) for shift in range(count)]
    mirrored = [row[::-1] for row in square] if count % 2 and count > 1 else []
    return (*square, *mirrored)


def balanced(conditions: Sequence[T], number: int) -> tuple[T, ...]:
    """The order for the participant of this number (from 1)."""
    orders = rows(len(conditions))
    return tuple(conditions[index] for index in orders[(number - 1) % len(orders)])


def rotated(tasks: Sequence[T], by: int) -> tuple[T, ...]:
    """The same round, begun so much later."""
    start = by % len(tasks)
    return (*tasks[start:], *tasks[:start])
