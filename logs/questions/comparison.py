"""Compares two recorded missions: their setup, the first difference, and their ends."""

from dataclasses import dataclass

from executive.text import printable
from logs.questions.decision import Decision
from logs.questions.difference import Aspect, Parting, aspects_text, parting
from logs.questions.why import why
from logs.recording.reader import Run


@dataclass(frozen=True, slots=True)
class Comparison:
    """The differences between two missions.

    Attributes:
        one: name of the first.
        other: name of the second.
        setup: settings and facts of the run that differ.
        parting: the first tick, or the outcome, that differs; None if all decisions are the same.
        decisions: for each mission, its first decision after those that both share; None if there
            is none.
        ends: how each mission ended.
    """

    one: str
    other: str
    setup: tuple[Aspect, ...]
    parting: Parting | None
    decisions: tuple[Decision | None, Decision | None]
    ends: tuple[str, str]


def compare(one: Run, other: Run) -> Comparison:
    """Compare two missions."""
    return Comparison(
        one.name,
        other.name,
        tuple(_setup(one, other)),
        parting(one, other),
        _first_of_its_own(why(one), why(other)),
        (_end(one), _end(other)),
    )


def _setup(one: Run, other: Run) -> list[Aspect]:
    facts = [run.config() | run.metadata for run in (one, other)]
    names = dict.fromkeys((*facts[0], *facts[1]))
    return [
        Aspect(name, *(str(fact.get(name, "")) for fact in facts))
        for name in names
        if name not in ("started", "runs") and facts[0].get(name) != facts[1].get(name)
    ]


def _first_of_its_own(
    one: list[Decision], other: list[Decision]
) -> tuple[Decision | None, Decision | None]:
    shared = 0
    for a, b in zip(one, other, strict=False):
        if (a.question, a.answer, a.source) != (b.question, b.answer, b.source):
            break
        shared += 1
    rests = one[shared:], other[shared:]
    return rests[0][0] if rests[0] else None, rests[1][0] if rests[1] else None


def _end(run: Run) -> str:
    outcome = run.outcome()
    return f"{outcome.status}: {outcome.reason}" if outcome else "the recording ends early"


def compare_text(compared: Comparison) -> str:
    """The comparison as text; A is the first mission, B the second."""
    names = ("A", "B")
    lines = [printable(f"A  {compared.one}"), printable(f"B  {compared.other}")]
    if compared.setup:
        lines += ["set up differently", aspects_text(compared.setup, names)]
    if compared.parting is None:
        return "\n".join([*lines, "decided alike, tick for tick"])
    where, time_s = compared.parting.tick, compared.parting.time_s
    tick = "after the last tick" if where is None else f"at tick {where}"
    lines += [f"part {tick}, {time_s:.3f} s", aspects_text(compared.parting.aspects, names)]
    lines.append("first decision of its own")
    for name, decision in zip(names, compared.decisions, strict=True):
        lines.append(
            printable(
                f"    {name}  {decision.time_s:.3f} s  {decision.question}: {decision.answer}"
            )
            if decision
            else f"    {name}  none"
        )
    lines.append("ended")
    ends = zip(names, compared.ends, strict=True)
    lines += [printable(f"    {name}  {end}") for name, end in ends]
    return "\n".join(lines)
