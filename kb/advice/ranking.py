"""Scores the known places instead of asking for a list: so the model cannot invent places.

The score of a place has two parts. One is the model's log-likelihood of the answer that names it,
minus that of the same answer to a neutral question, so that a place does not win because it is a
common phrase (Holtzman et al., "Surface Form Competition", EMNLP 2021). The other is where similar
things are known to be (`precedents.py`).
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from executive.language.phrases import spoken
from executive.types.home import Place
from executive.types.knowledge import Candidate, Source
from executive.types.llm import Precedent, RankRequest
from executive.types.results import Scored
from kb.advice.prompts import Ranking
from kb.ontology.names import base_name

ANY_PLACE = "Furniture"
"""The class of all furniture."""
MOST_PRECEDENTS = 300
"""More would take the embedded model many seconds, once."""


@dataclass(frozen=True, slots=True)
class Known:
    """A thing: its name, its class (empty: none), and the names of its places."""

    name: str
    kind: str = ""
    places: tuple[str, ...] = ()


def rank_request(
    thing: Known,
    options: Sequence[tuple[Place, str]],
    texts: Ranking,
    others: Iterable[Known] = (),
) -> RankRequest:
    """A request for the score of each answer about this thing.

    Args:
        thing: what is asked about. Its class is only used to compare it with others: with the
            class in the prompt ("hammer (a tool)"), the embedded model ranked worse.
        options: the places, each with the answer that names it (see `answer`).
        texts: the question and its examples.
        others: things with known places; those at none of the options are ignored.
    """
    places = {place.name for place, _ in options}
    here = (other for other in others if not places.isdisjoint(other.places))
    likest = sorted(here, key=lambda other: other.kind != thing.kind)[:MOST_PRECEDENTS]
    return RankRequest(
        label="rank",
        messages=texts.chat(spoken(thing.name)),
        neutral=texts.chat(texts.neutral),
        options=tuple(text for _, text in options),
        places=tuple(place.name for place, _ in options),
        precedents=tuple(
            Precedent(texts.chat(spoken(other.name)), other.places, other.kind) for other in likest
        ),
        kind=thing.kind,
        place_kinds=tuple((_class_of(place.kind), place.room) for place, _ in options),
    )


def _class_of(kind: str) -> str:
    """The class of a place; empty if it is only "Furniture"."""
    return "" if kind == ANY_PLACE else kind


def answer(place: Place, preposition: str) -> str:
    """Where a thing in this place is, in words: "in the cabinet in the kitchen"."""
    return f"{preposition} the {base_name(place)} in the {spoken(place.room)}"


def ranked(scored: Scored) -> tuple[Candidate, ...]:
    """Places by the softmax of their scores, likeliest first; ties in the order of the request."""
    probabilities = softmax(scored.scores)
    candidates = [
        Candidate(place, Source.LLM, probability)
        for place, probability in zip(scored.request.places, probabilities, strict=True)
    ]
    return tuple(sorted(candidates, key=lambda c: -(c.probability or 0.0)))


def softmax(scores: Sequence[float]) -> list[float]:
    """Probabilities proportional to exp(score); uniform if no score is finite."""
    best = max(scores, default=0.0)
    if not math.isfinite(best):
        return [1 / len(scores)] * len(scores)
    weights = [math.exp(score - best) for score in scores]
    return [weight / sum(weights) for weight in weights]
