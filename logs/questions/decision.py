"""One decision from the words to the deed: what was decided, by whom, and what was not taken."""

from collections.abc import Iterable
from dataclasses import dataclass

from executive.text import printable

WORLD = "world"
"""Source of a fault that was injected into the simulation."""
PERSON, EYES = "person", "eyes"
"""Sources of what was heard and what was seen."""
NOT_NEEDED = "not needed"


@dataclass(frozen=True, slots=True)
class Alternative:
    """An alternative, and why it was not taken."""

    what: str
    why_not: str


@dataclass(frozen=True, slots=True)
class Decision:
    """One decision.

    Attributes:
        time_s: mission time of the decision (s).
        question: what was to be decided, in the words of the tree.
        answer: the result.
        source: as declared by the behaviour, such as `person`, `ontology`, `llm`, `user`; or
            `eyes`, `world` or `experimenter`; empty if the tree itself decides.
        by: path of the behaviour that decided; of an intervention, who stepped in; of the outcome,
            its status; else empty.
        alternatives: what was not taken.
    """

    time_s: float
    question: str
    answer: str
    source: str
    by: str
    alternatives: tuple[Alternative, ...] = ()


def why_text(decisions: Iterable[Decision]) -> str:
    """A paragraph for each decision: the result, its source, and the other alternatives."""
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
