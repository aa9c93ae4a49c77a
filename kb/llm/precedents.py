"""Like things are kept in like places: what is known of other things says where a new one may be.

How alike two things are is the language model's own judgement: the angle between its hidden states
where it is about to say where they are. These states have been computed anyway when the answer is
scored, and a thing that is known costs a handful of tokens, once. From them kernel ridge regression
(Hastie et al., "The Elements of Statistical Learning", 5.8) expects how much of a thing each place
has. The further a thing is from all that is known, the nearer the answer is to how often each place
is used at all; and with little known, to all places alike.

The constants were chosen for the embedded model on the train and valid folds of the placements that
`python -m kb.benchmark` asks for; its table shows what each means brings.
"""

from collections.abc import Sequence

import numpy as np

from executive.geometry import Floats

LIKELIHOOD_WEIGHT = 0.2
"""Models are far too sure of which words come next; this makes probabilities of it."""
RIDGE = 0.1
"""How much of what single things suggest is noise, where 1 is a thing's likeness to itself."""
UNDECIDED = 10
"""So many things that may be anywhere are thought beside those that are known."""
SAME_KIND = 0.2
"""How alike things are by being of the same class; the rest is how alike they are to the model."""
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


def log_expected(states: Floats, kinds: Sequence[str], at: Floats) -> Floats:
    """(options,) log of how much of a thing to expect at each option.

    Args:
        states: (1 + things, d) the model's states: about the thing in question, then about things
            whose places are known, one at least.
        kinds: their classes, in the same order; things of no class ("") are like nothing by it.
        at: (things, options) as `shares` has it.
    """
    like = (1 - SAME_KIND) * _cosines(states - states[1:].mean(axis=0)) + SAME_KIND * _same(kinds)
    asked, known = like[0, 1:], like[1:, 1:]
    mean = usual(at)
    expected = mean + asked @ np.linalg.solve(known + RIDGE * np.eye(len(at)), at - mean)
    return np.asarray(np.log(np.maximum(expected, LEAST)))


def _cosines(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    directions = vectors / np.maximum(lengths, NO_LENGTH)
    return np.asarray(directions @ directions.T)


def _same(kinds: Sequence[str]) -> Floats:
    return np.array([[bool(a) and a == b for b in kinds] for a in kinds], dtype=float)
