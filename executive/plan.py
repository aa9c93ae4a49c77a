"""Where to look, in which order, and when to ask: the plan that costs least by its expectation.

A look brings no news but "not here". So a plan is an order of places and a moment to ask, and what
it costs can be expected exactly. Over up to `EXACT` places the best of all plans is found, by
dynamic programming over the subsets of what was looked at (Held and Karp, "A dynamic programming
approach to sequencing problems", 1962); with more, the same is done for one stretch of the order
after the other, until that brings nothing more.

Pure functions of numbers: nothing of robots, trees or clocks.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import inf, isfinite

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats

EXACT = 12
"""Of so many places the best plan is found: it takes milliseconds."""
STEP = 4
"""With more places, as many are put in order at once, and then those that begin so many earlier."""
FIRST = 24
"""So far from the beginning of the order: what comes later hardly counts."""
SWEEPS = 3
"""The order is gone through at most so often."""
GAIN = 1e-9
"""What is cheaper by less than this is as dear."""
FAR_S = 1e9
"""As long as the way takes where there is none."""


@dataclass(frozen=True, slots=True)
class Chance:
    """A place that may be looked at: how likely the thing is there (from 0 to 1)."""

    place: str
    probability: float


@dataclass(frozen=True, slots=True)
class Prices:
    """What a question to the person and a visit cost, in seconds of searching.

    A question of infinite price is never asked: nobody answers. The price of a visit comes on top
    of its seconds.
    """

    question_s: float = 60.0
    visit_s: float = 0.0


@dataclass(frozen=True, slots=True)
class Expectation:
    """What is to be expected of a way to go on.

    Attributes:
        seconds: of ways and looks, until the thing is seen or is known to be nowhere.
        visits: how many places will be looked at.
        questions: how many questions will be asked (at most 1).
        cost: all of it, in seconds by the prices.
    """

    seconds: float
    visits: float
    questions: float
    cost: float


@dataclass(frozen=True, slots=True)
class Plan:
    """An order of places, and after how many of them the person is asked.

    Attributes:
        order: where to look before that, or at all; places that cannot be reached are not in it.
        ask_after: how many of `order` are looked at before the question; None: never.
        expected: what it comes to.
        asking: what asking at once comes to; None if that is no choice.
        looking: what the best plan comes to that begins with a look; None if there is none.
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
    """The plan that costs least.

    Once the person is asked, the robot goes to where they say; they know. Of what is equally good,
    the plan is taken that asks sooner.

    Args:
        chances: the places, each once; what they sum to is no matter.
        first_s: of each the seconds of the way from where the robot is, and of the look there;
            infinite if there is no way.
        between_s: the same from each place to each other one.
        prices: of a question and of a visit.
        elsewhere: how likely the thing is at none of these places, or at one that was looked at.
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
    """The numbers: `first` (n,) and `between` (n, n) are seconds with the price of a visit."""

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
        """The places that can be reached and are worth it."""
        worth = np.isfinite(self.first) & (self.chance > 0)
        return np.flatnonzero(worth).tolist()

    def expectation(self, order: Sequence[int], ask_after: int | None) -> Expectation:
        """What looking in this order comes to, with the question after so many looks."""
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
    """The best order of all places that can be reached, if the first thing to do is a look."""
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
    """Always on to where most is found by the second."""
    ways, left, order = problem.first, problem.open, list[int]()
    while left:
        by_the_second = problem.chance[left] / np.clip(ways[left], GAIN, FAR_S)
        order.append(left.pop(int(by_the_second.argmax())))
        ways = problem.between[order[-1]]
    return order


def _stretch(problem: _Problem, order: list[int], start: int, length: int) -> list[int]:
    """The order, with so many places from `start` on arranged as well as can be."""
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
    """(layer, starts) what the best plan costs that goes on with a look, from these subsets."""
    best = np.full((len(layer), len(inside)), inf)
    for j, ways in enumerate(inside.T):
        ahead = np.where(layer >> j & 1, inf, value[layer | (1 << j), j])
        np.minimum(best, left[:, None] * ways + ahead[:, None], out=best)
    return best


def _followed(
    places: list[int], value: Floats, end: Floats, left: Floats, inside: Floats, looks: bool
) -> list[int]:
    """The places in the order of the best plan; those after the question as they were."""
    order, at, subset, rest = list[int](), len(places), 0, list(range(len(places)))
    while rest:
        ahead = [left[subset] * inside[at, j] + value[subset | (1 << j), j] for j in rest]
        best = int(np.argmin(ahead))
        if ahead[best] > end[subset, at] - GAIN and not (looks and subset == 0):
            break  # to ask is as good; that it is not good at once is looked at apart
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
    """(subsets, starts) what it costs to ask, once these were looked at, from each start."""
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
    """(starts,) what looking on along the tail costs from each start; infinite if there is none."""
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
    """Of k places: (2**k, k) which are in each subset; the subsets by size, but for the whole."""
    numbers = np.arange(2**k)
    members = (numbers[:, None] >> np.arange(k)) & 1 == 1
    sizes = members.sum(axis=1)
    return members, tuple(np.flatnonzero(sizes == size) for size in range(k))
