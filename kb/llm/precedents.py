"""Like things are kept in like places: what is known of other things says where a new one may be.

How alike two things are is the language model's own judgement: the angle between its hidden states
where it is about to say where they are. These states have been computed anyway when the answer is
scored, and a thing that is known costs a handful of tokens, once. Places are alike, too, by their
class and room: that counts where each thing was seen at one place only. From both, kernel ridge
regression (Hastie et al., "The Elements of Statistical Learning", 5.8) expects whether a thing is
ever kept at a place. The further a thing is from all that is known, the nearer the answer is to how
often each place is used at all; and with little known, to all places alike.

How much of what single things suggest is noise, and how sure the answer may be, is found anew in
each home, by what would have been expected of each thing that is known without itself.

The constants were chosen for the embedded model on the train and valid folds of the placements that
`python -m kb.benchmark` asks for; its table shows what each means brings.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from executive.geometry import Floats

LIKELIHOOD_WEIGHT = 0.2
"""Models are far too sure of which words come next; this makes probabilities of it."""
LIKELIHOOD_WEIGHT_BESIDE_OTHERS = 0.1
"""The same, where more than a `FEW` things are known."""
FEW = 12
"""So few things that are known cannot tell what is noise, nor how sure the answer may be."""
RIDGE_OF_FEW = 0.3
RIDGES = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
"""How much of what single things suggest may be noise, where 1 is the likeness to itself."""
TEMPERATURES = np.geomspace(0.3, 3.0, 24)
"""How much less sure than the regression the answer may be; below 1: surer."""
UNDECIDED = 10
"""So many things that may be anywhere are thought beside those that are known."""
SAME_KIND = 0.2
"""How alike things are by being of the same class; the rest is how alike they are to the model."""
NEARNESS = 0.4
"""Likeness falls to a third where things are so much less alike."""
ANY_PLACES, SAME_CLASS, SAME_ROOM = 0.1, 0.4, 0.2
"""How alike two places are at least, and by being of one class, or in one room; 1 is the same."""
LEAST = 0.005
"""No place is ruled out."""

NO_LENGTH = 1e-6
"""States differ by ones and tens; those that differ by less than this are the same."""


def shares(places: Sequence[Sequence[str]], options: Sequence[str]) -> Floats:
    """(things, options): how much of each thing is at each option; 0 if it is elsewhere."""
    at = np.array([[option in there for option in options] for there in places], dtype=float)
    at = at.reshape(len(places), len(options))
    return np.asarray(at / np.maximum(at.sum(axis=1, keepdims=True), 1))


def usual(at: Floats) -> Floats:
    """(options,) how much of anything to expect at each option."""
    return np.asarray((at.sum(axis=0) + UNDECIDED / at.shape[1]) / (len(at) + UNDECIDED))


def likelihood_weight(known: int) -> float:
    """How much the model's likelihood of the answer counts beside so many things that are known."""
    return LIKELIHOOD_WEIGHT if known <= FEW else LIKELIHOOD_WEIGHT_BESIDE_OTHERS


def log_expected(
    states: Floats, kinds: Sequence[str], at: Floats, places: Sequence[tuple[str, str]] = ()
) -> Floats:
    """(options,) log of how likely a thing is at each option, up to a constant.

    Args:
        states: (1 + things, d) the model's states: about the thing in question, then about things
            whose places are known, one at least.
        kinds: their classes, in the same order; things of no class ("") are like nothing by it.
        at: (things, options) as `shares` has it.
        places: class and room of each option; none: no two options are alike.
    """
    likeness = _likeness(states, kinds)
    learned = _Learned.of(likeness[1:, 1:], _places_alike(places, at.shape[1]), at)
    return np.asarray(np.log(learned.expected(likeness[0, 1:])) / learned.temperature)


@dataclass(frozen=True, eq=False)
class _Learned:
    """What is to be expected of a thing by how alike it is to those that are known."""

    mean: Floats
    weights: Floats
    """(things, options)"""
    temperature: float

    @classmethod
    def of(cls, things: Floats, places: Floats, at: Floats) -> Self:
        """Regress on both likenesses at once: their product is that of a thing at a place."""
        ever = np.asarray(at > 0, dtype=float)
        mean = usual(ever)
        strengths, axes = np.linalg.eigh(things)
        spreads, turns = np.linalg.eigh(places)
        strengths, spreads = np.maximum(strengths, 0.0)[:, None], np.maximum(spreads, NO_LENGTH)
        turned = (ever - mean) @ turns
        parts = axes.T @ turned

        def left_out(ridge: float) -> Floats:
            """What the regression misses of each thing by all the others."""
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
        """(options,) of a thing that is so much like each of those that are known."""
        return np.asarray(np.maximum(self.mean + likeness @ self.weights, LEAST))


def _temperature(foreseen: Floats, at: Floats) -> float:
    """That with which the probabilities of what is known were best foreseen, by their logarithm.

    With few things that are known it is 1.
    """
    if len(at) <= FEW:
        return 1.0

    def score(temperature: float) -> float:
        logs = np.log(foreseen) / temperature
        sums = np.log(np.exp(logs - logs.max(axis=1, keepdims=True)).sum(axis=1, keepdims=True))
        return float((at * (logs - logs.max(axis=1, keepdims=True) - sums)).sum())

    return float(max(TEMPERATURES, key=score))


def _likeness(states: Floats, kinds: Sequence[str]) -> Floats:
    """(1 + things, 1 + things) how alike things are, from 0 to 1."""
    directions = (1 - SAME_KIND) * _cosines(states - states[1:].mean(axis=0))
    return np.asarray(np.exp((directions + SAME_KIND * _same(kinds) - 1) / NEARNESS))


def _places_alike(places: Sequence[tuple[str, str]], options: int) -> Floats:
    """(options, options) how alike places are, from 0 to 1."""
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
