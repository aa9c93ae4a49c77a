"""Predicts the place of a thing from known places of other things: like things, like places.

The likeness of two things is judged by the language model: the angle between its hidden states at
the point where it would name the place. These states are computed anyway when the answer is scored;
a known thing costs a few tokens, once. Places are alike, too, by class and room, which matters if
each thing was seen at only one place. From both kernels, kernel ridge regression (Hastie et al.,
"The Elements of Statistical Learning", 5.8) predicts whether a thing is ever kept at a place. For a
thing unlike all known ones, the prediction tends to how often each place is used in general; with
few known things, to a uniform distribution.

The noise level (ridge) and the confidence (temperature) are fitted in each home by leave-one-out
predictions of the known things.

The constants were chosen for the embedded model on the train and valid folds of the placements in
`python -m kb.benchmark`; its table shows the effect of each method.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from executive.geometry import Floats

LIKELIHOOD_WEIGHT = 0.2
"""Scale of the model's log-likelihoods, which are far too confident for probabilities."""
LIKELIHOOD_WEIGHT_BESIDE_OTHERS = 0.1
"""The same if more than `FEW` things are known."""
FEW = 12
"""With so few known things, ridge and temperature cannot be fitted."""
RIDGE_OF_FEW = 0.3
RIDGES = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
"""Candidates for the noise variance; the likeness of a thing to itself is 1."""
TEMPERATURES = np.geomspace(0.3, 3.0, 24)
"""Candidates for the temperature of the prediction; below 1 it becomes more confident."""
UNDECIDED = 10
"""Weight of the uniform prior, as a number of known things."""
SAME_KIND = 0.2
"""The weight of "same class" in the likeness of things; the rest is the model's judgement."""
NEARNESS = 0.4
"""Length scale: the likeness falls to 1/e at this distance."""
ANY_PLACES, SAME_CLASS, SAME_ROOM = 0.1, 0.4, 0.2
"""Likeness of two different places: the minimum, plus the bonus for the same class or room."""
LEAST = 0.005
"""Minimum probability, so that no place is excluded."""

NO_LENGTH = 1e-6
"""Smaller lengths count as zero; states differ by ones and tens."""


def shares(places: Sequence[Sequence[str]], options: Sequence[str]) -> Floats:
    """(things, options) the share of each thing at each option; 0 if it is elsewhere."""
    at = np.array([[option in there for option in options] for there in places], dtype=float)
    at = at.reshape(len(places), len(options))
    return np.asarray(at / np.maximum(at.sum(axis=1, keepdims=True), 1))


def usual(at: Floats) -> Floats:
    """(options,) the prior: how much of any thing to expect at each option."""
    return np.asarray((at.sum(axis=0) + UNDECIDED / at.shape[1]) / (len(at) + UNDECIDED))


def likelihood_weight(known: int) -> float:
    """Weight of the model's log-likelihood if so many things are known."""
    return LIKELIHOOD_WEIGHT if known <= FEW else LIKELIHOOD_WEIGHT_BESIDE_OTHERS


def log_expected(
    states: Floats, kinds: Sequence[str], at: Floats, places: Sequence[tuple[str, str]] = ()
) -> Floats:
    """(options,) log of the probability that a thing is at each option, up to a constant.

    Args:
        states: (1 + things, d) hidden states: of the thing in question, then of the things whose
            places are known, at least one.
        kinds: their classes, in the same order; "" (no class) is like no other.
        at: (things, options) from `shares`.
        places: class and room of each option; if empty, no two options are alike.
    """
    likeness = _likeness(states, kinds)
    learned = _Learned.of(likeness[1:, 1:], _places_alike(places, at.shape[1]), at)
    return np.asarray(np.log(learned.expected(likeness[0, 1:])) / learned.temperature)


@dataclass(frozen=True, eq=False)
class _Learned:
    """The fitted regression: predicts places from the likeness to the known things."""

    mean: Floats
    weights: Floats
    """(things, options)"""
    temperature: float

    @classmethod
    def of(cls, things: Floats, places: Floats, at: Floats) -> Self:
        """Fit; the kernel of (thing, place) pairs is the product of both likenesses."""
        ever = np.asarray(at > 0, dtype=float)
        mean = usual(ever)
        strengths, axes = np.linalg.eigh(things)
        spreads, turns = np.linalg.eigh(places)
        strengths, spreads = np.maximum(strengths, 0.0)[:, None], np.maximum(spreads, NO_LENGTH)
        turned = (ever - mean) @ turns
        parts = axes.T @ turned

        def left_out(ridge: float) -> Floats:
            """(things, options) leave-one-out residuals, in the eigenbasis of the places."""
            kept = strengths / (strengths + ridge / spreads)
            own = np.minimum(axes**2 @ kept, 1 - NO_LENGTH)
            return np.asarray((turned - axes @ (kept * parts)) / (1 - own))

        ridges = RIDGES if len(at) > FEW else (RIDGE_OF_FEW,)
        missed = {ridge: left_out(ridge) for ridge in ridges}
        ridge = min(ridges, key=lambda ridge: float((missed[ridge] ** 2).sum()))
        weights = axes @ (parts / (strengths + ridge / spreads)) @ turns.T
        foreseen = np.maximum(mean + (turned - missed[ridge]) @ turns.T, LEAST)
        return cls(mean, weights, _temperature(foreseen, at))

    def expected(self, likeness: Floats) -> Floats:
        """(options,) prediction for a thing with this likeness to each known thing."""
        return np.asarray(np.maximum(self.mean + likeness @ self.weights, LEAST))


def _temperature(foreseen: Floats, at: Floats) -> float:
    """The temperature with the best log-score of the leave-one-out predictions.

    With at most `FEW` known things it is 1.
    """
    if len(at) <= FEW:
        return 1.0

    def score(temperature: float) -> float:
        logs = np.log(foreseen) / temperature
        sums = np.log(np.exp(logs - logs.max(axis=1, keepdims=True)).sum(axis=1, keepdims=True))
        return float((at * (logs - logs.max(axis=1, keepdims=True) - sums)).sum())

    return float(max(TEMPERATURES, key=score))


def _likeness(states: Floats, kinds: Sequence[str]) -> Floats:
    """(1 + things, 1 + things) likeness of things, from 0 to 1."""
    directions = (1 - SAME_KIND) * _cosines(states - states[1:].mean(axis=0))
    return np.asarray(np.exp((directions + SAME_KIND * _same(kinds) - 1) / NEARNESS))


def _places_alike(places: Sequence[tuple[str, str]], options: int) -> Floats:
    """(options, options) likeness of places, from 0 to 1."""
    if not places:
        return np.eye(options)
    classes, rooms = (_same([place[part] for place in places]) for part in (0, 1))
    alike = ANY_PLACES + SAME_CLASS * classes + SAME_ROOM * rooms
    np.fill_diagonal(alike, 1.0)
    return alike


def _cosines(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    directions = vectors / np.maximum(lengths, NO_LENGTH)
    return np.asarray(directions @ directions.T)


def _same(kinds: Sequence[str]) -> Floats:
    return np.array([[bool(a) and a == b for b in kinds] for a in kinds], dtype=float)
