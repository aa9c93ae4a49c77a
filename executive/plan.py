"""Where to look, in which order, and when to ask: the plan with the least expected cost.

A look that fails tells only "not here". So a plan is an order of places and a moment to ask, and
its expected cost can be computed exactly. For up to `EXACT` places the optimal plan is found, by
dynamic programming over the subsets of visited places (Held and Karp, "A dynamic programming
approach to sequencing problems", 1962). For more places, this is applied to one segment of the
order after the other, until nothing improves.

Pure functions of numbers, independent of robots, trees and clocks.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import inf, isfinite

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats

EXACT = 12
"""The largest number of places for which the optimal plan is computed, in milliseconds."""
STEP = 4
"""For more places, segments of `EXACT` places are optimised, each starting this much earlier."""
FIRST = 24
"""Only this many places at the beginning of the order are optimised: later ones hardly matter."""
SWEEPS = 3
"""The largest number of passes over the order."""
GAIN = 1e-9
"""Costs that differ by less than this are equal."""
FAR_S = 1e9
"""The duration that stands for a drive without a path."""


@dataclass(frozen=True, slots=True)
class Chance:
    """A place that may be looked at, and the probability that the thing is there."""

    place: str
    probability: float


@dataclass(frozen=True, slots=True)
class Prices:
    """The costs of a question to the person and of a visit, in seconds of searching.

    A question of infinite cost is never asked: nobody answers. The cost of a visit is added to its
    duration.
    """

    question_s: float = 60.0
    visit_s: float = 0.0


@dataclass(frozen=True, slots=True)
class Expectation:
    """The expected values of one option.

    Attributes:
        seconds: duration of drives and looks, until the thing is seen or all places were seen.
        visits: number of places looked at.
        questions: number of questions (at most 1).
        cost: total cost in seconds, with the prices of questions and visits.
    """

    seconds: float
    visits: float
    questions: float
    cost: float


@dataclass(frozen=True, slots=True)
class Plan:
    """An order of places, and after how many of them to ask the person.

    Attributes:
        order: where to look before the question, if there is one; only reachable places.
        ask_after: how many of `order` to look at before the question; None: never ask.
        expected: the expected values of this plan.
        asking: those of asking at once; None if that is impossible.
        looking: those of the best plan that begins with a look; None if there is none.
    """

    order: tuple[str, ...]
    ask_after: int | None
    expected: Expectation
    asking: Expectation | None
    looking: Expectation | None

    @property
    def asks(self) -> bool:
        """Whether the next thing to do is to ask."""
        return self.ask_after == 0

    @property
    def is_over(self) -> bool:
        """Whether nothing is left to do."""
        return not self.order and self.ask_after is None


def best_plan(
    chances: Sequence[Chance],
    first_s: Sequence[float],
    between_s: Sequence[Sequence[float]],
    prices: Prices = Prices(),
    elsewhere: float = 0.0,
) -> Plan:
    """Compute the plan with the least expected cost.

    The person is assumed to know the place; after a question, the robot goes there. Of plans with
    equal cost, the one that asks earlier is taken.

    Args:
        chances: the places, each once; the probabilities need not sum to 1.
        first_s: (n,) seconds to drive to each place from here, and look there; infinite if there
            is no path.
        between_s: (n, n) the same from each place (row) to each other one (column).
        prices: costs of a question and of a visit.
        elsewhere: probability that the thing is at none of these places, or at a visited one.
    """
    problem = _Problem.of(chances, first_s, between_s, prices, elsewhere)
    asking = problem.expectation((), 0) if problem.may_ask else None
    if not problem.open:
        return Plan((), 0 if problem.may_ask else None, asking or _NOTHING, asking, None)
    order = _ordered(problem)
    moments = [*range(1, len(order) + 1)] if problem.may_ask else [None]
    told = [(problem.expectation(order, moment), moment) for moment in moments]
    looking, ask_after = min(told, key=lambda pair: pair[0].cost)
    names = tuple(chances[i].place for i in order)
    if asking and asking.cost <= looking.cost + GAIN:
        return Plan((), 0, asking, asking, looking)
    return Plan(names[:ask_after], ask_after, looking, asking, looking)


_NOTHING = Expectation(0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class _Problem:
    """The normalised input: `first` (n,) and `between` (n, n) are seconds with a visit's price."""

    chance: Floats
    elsewhere: float
    first: Floats
    between: Floats
    prices: Prices

    @classmethod
    def of(
        cls,
        chances: Sequence[Chance],
        first_s: Sequence[float],
        between_s: Sequence[Sequence[float]],
        prices: Prices,
        elsewhere: float,
    ) -> "_Problem":
        n = len(chances)
        weights = np.array([c.probability for c in chances], dtype=float).reshape(n)
        total = float(weights.sum()) + elsewhere
        scale = 1 / total if total > 0 else 0.0
        return cls(
            weights * scale,
            elsewhere * scale if total > 0 else 1.0,
            np.array(first_s, dtype=float).reshape(n) + prices.visit_s,
            np.array(between_s, dtype=float).reshape(n, n) + prices.visit_s,
            prices,
        )

    @property
    def may_ask(self) -> bool:
        return isfinite(self.prices.question_s)

    @property
    def open(self) -> list[int]:
        """Indices of the places that are reachable and have a probability above 0."""
        worth = np.isfinite(self.first) & (self.chance > 0)
        return np.flatnonzero(worth).tolist()

    def expectation(self, order: Sequence[int], ask_after: int | None) -> Expectation:
        """The expected values of looking in this order, with a question after `ask_after` looks."""
        left, cost, visits = 1.0, 0.0, 0.0
        ways, at = self.first, list(order[:ask_after])
        for place in at:
            cost += left * min(float(ways[place]), FAR_S)
            visits += left
            left = max(0.0, left - float(self.chance[place]))
            ways = self.between[place]
        questions = 0.0
        if ask_after is not None:
            rest = np.isfinite(ways) & (self.chance > 0)
            rest[at] = False
            cost += float(self.chance[rest] @ ways[rest])
            visits += float(self.chance[rest].sum())
            questions = left
        seconds = cost - visits * self.prices.visit_s
        asked = questions * self.prices.question_s if questions else 0.0
        return Expectation(seconds, visits, questions, cost + asked)


def _ordered(problem: _Problem) -> list[int]:
    """The best order of all reachable places, given that the first step is a look."""
    order = _greedy(problem)
    if len(order) <= EXACT:
        return _stretch(problem, order, 0, len(order))
    last = min(len(order), FIRST) - EXACT
    for _ in range(SWEEPS):
        before = order
        for start in [*range(last, 0, -STEP), 0]:
            order = _stretch(problem, order, start, EXACT)
        if order == before:
            break
    return order


def _greedy(problem: _Problem) -> list[int]:
    """Always go next to the place with the highest probability per second."""
    ways, left, order = problem.first, problem.open, list[int]()
    while left:
        by_the_second = problem.chance[left] / np.clip(ways[left], GAIN, FAR_S)
        order.append(left.pop(int(by_the_second.argmax())))
        ways = problem.between[order[-1]]
    return order


def _stretch(problem: _Problem, order: list[int], start: int, length: int) -> list[int]:
    """The order, with `length` places from `start` on in their optimal order."""
    places = order[start : start + length]
    head, tail = order[:start], order[start + length :]
    k = len(places)
    before = 1.0 - float(problem.chance[head].sum())
    ways = np.vstack(
        [problem.between[places], problem.first if not head else problem.between[head[-1]]]
    )
    inside = np.minimum(ways[:, places], FAR_S)
    members, layers = _subsets(k)
    chance = problem.chance[places]
    left = np.maximum(before - members @ chance, 0.0)
    end = _ends(problem, ways, places, tail, members, left)
    value = end.copy()
    value[-1] = np.minimum(end[-1], _going_on(problem, ways, tail, float(left[-1])))
    for layer in reversed(layers):
        looked = _looked(value, layer, left[layer], inside)
        value[layer] = np.minimum(value[layer], looked)
    return [*head, *_followed(places, value, end, left, inside, not head), *tail]


def _looked(value: Floats, layer: NDArray[np.intp], left: Floats, inside: Floats) -> Floats:
    """(layer, starts) cost of the best plan that continues with a look, from these subsets."""
    best = np.full((len(layer), len(inside)), inf)
    for j, ways in enumerate(inside.T):
        ahead = np.where(layer >> j & 1, inf, value[layer | (1 << j), j])
        np.minimum(best, left[:, None] * ways + ahead[:, None], out=best)
    return best


def _followed(
    places: list[int], value: Floats, end: Floats, left: Floats, inside: Floats, looks: bool
) -> list[int]:
    """The places in the order of the best plan; those after the question in their old order."""
    order, at, subset, rest = list[int](), len(places), 0, list(range(len(places)))
    while rest:
        ahead = [left[subset] * inside[at, j] + value[subset | (1 << j), j] for j in rest]
        best = int(np.argmin(ahead))
        if ahead[best] > end[subset, at] - GAIN and not (looks and subset == 0):
            break  # asking is as good; `best_plan` compares asking at once separately
        at = rest.pop(best)
        order.append(at)
        subset |= 1 << at
    return [places[i] for i in (*order, *rest)]


def _ends(
    problem: _Problem,
    ways: Floats,
    places: list[int],
    tail: list[int],
    members: NDArray[np.bool_],
    left: Floats,
) -> Floats:
    """(subsets, starts) cost of asking once these were looked at, from each start."""
    if not problem.may_ask:
        end = np.full((len(members), len(ways)), inf)
        if not tail:
            end[-1] = 0.0
        return end
    reached = np.where(np.isfinite(ways), ways, 0.0) * problem.chance
    inside = ~members @ reached[:, places].T
    return np.asarray(
        inside + reached[:, tail].sum(axis=1) + left[:, None] * problem.prices.question_s
    )


def _going_on(problem: _Problem, ways: Floats, tail: list[int], left: float) -> Floats:
    """(starts,) cost of looking along the tail, from each start; infinite if it is empty."""
    if not tail:
        return np.full(len(ways), inf)
    value = 0.0
    chance = problem.chance[tail]
    lefts = np.maximum(left - np.concatenate([[0.0], np.cumsum(chance)]), 0.0)
    between, ask_s = np.minimum(problem.between, FAR_S), problem.prices.question_s
    reached = np.where(np.isfinite(problem.between), problem.between, 0.0) * problem.chance
    for index in range(len(tail) - 1, -1, -1):
        here, rest = tail[index], tail[index + 1 :]
        on = lefts[index + 1] * between[here, rest[0]] + value if rest else inf
        if problem.may_ask:
            value = min(on, float(reached[here, rest].sum()) + lefts[index + 1] * ask_s)
        else:
            value = on if rest else 0.0
    return np.asarray(left * np.minimum(ways[:, tail[0]], FAR_S) + value)


@cache
def _subsets(k: int) -> tuple[NDArray[np.bool_], tuple[NDArray[np.intp], ...]]:
    """(2**k, k) the members of each subset of k places; and the proper subsets by size."""
    numbers = np.arange(2**k)
    members = (numbers[:, None] >> np.arange(k)) & 1 == 1
    sizes = members.sum(axis=1)
    return members, tuple(np.flatnonzero(sizes == size) for size in range(k))
