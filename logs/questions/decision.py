"""One link of the chain from words to deed: what was settled, by whom, and what was not taken."""

from collections.abc import Iterable
from dataclasses import dataclass

from executive.text import printable

WORLD = "world"
"""Whose doing an ordered fault is."""
PERSON, EYES = "person", "eyes"
"""Who says what was heard, and what was looked at."""
NOT_NEEDED = "not needed"


@dataclass(frozen=True, slots=True)
class Alternative:
    """What could have been instead, and why it was not."""

    what: str
    why_not: str


@dataclass(frozen=True, slots=True)
class Decision:
    """One link of the chain.

    Attributes:
        time_s: mission time at which it was settled.
        question: what was to be settled, as the tree names it.
        answer: what came of it.
        source: as the behaviour declares it: `person`, `ontology`, `llm`, `user`; or `eyes`,
            `world` or `experimenter`; empty where the tree itself decides.
        by: the behaviour that settled it.
        alternatives: what was not taken.
    """

    time_s: float
    question: str
    answer: str
    source: str
    by: str
    alternatives: tuple[Alternative, ...] = ()


def why_text(decisions: Iterable[Decision]) -> str:
    """A paragraph for each decision: what was settled, by whom, and what was not taken."""
    return "\n".join(map(_text, decisions)) or "nothing was decided: the recording has no ticks"


def _text(decision: Decision) -> str:
    says = f"  [{decision.source}]" if decision.source else ""
    lines = [f"{decision.time_s:9.3f}  {decision.question}: {decision.answer}{says}"]
    lines += [
        f"{'':13}- {a.what}: {a.why_not}" for a in decision.alternatives if a.why_not != NOT_NEEDED
    ]
    spare = [a.what for a in decision.alternatives if a.why_not == NOT_NEEDED]
    if spare:
        lines.append(f"{'':13}- not needed: {', '.join(spare)}")
    return "\n".join(map(printable, lines))
