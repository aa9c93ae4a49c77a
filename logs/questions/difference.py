"""Finds the first tick in which two missions differ."""

import json
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields
from itertools import zip_longest
from typing import Any

from executive.records import NodeState, Tick
from executive.text import printable
from executive.types.outcome import Outcome
from logs.recording.reader import At, Run

OF_THE_RUN = ("mission_time_s", "thinking_time_s", "wall_time_s", "run_dir")
"""Fields of an outcome that differ from run to run, even with the same decisions."""
MEASURED = ("deadlines", "sighting", "doubtful", "unreached", "unplaced", "model_failure", "reason")
"""Fields of a situation with measured times and places, which are never exactly the same."""
ENDED = "has ended"
LONGEST_SHOWN = 150
"""Maximum length of a shown value (characters): a belief names every place of a home."""


@dataclass(frozen=True, slots=True)
class Aspect:
    """One difference, with the value on each side.

    `behaviour`: whether `what` is the path of a behaviour.
    """

    what: str
    one: str
    other: str
    behaviour: bool = field(default=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Parting:
    """The first tick that differs (None: only the outcomes differ), and its differences.

    `time_s` is the mission time (s): that of the first mission, unless only the second has such a
    tick.
    """

    tick: int | None
    time_s: float
    aspects: tuple[Aspect, ...]


def tick_aspects(one: Tick, other: Tick, *, exact: bool) -> Iterator[Aspect]:
    """The differences between two ticks.

    Behaviours and facts on only one side are ignored, so that a changed tree can be compared with
    an older recording. So are behaviours that differ only because one inside them does.

    Args:
        one: a tick.
        other: the tick with the same number.
        exact: whether messages and measured values count, as between a mission and its replay.
    """
    if one.cause != other.cause:
        yield Aspect("cause", one.cause, other.cause)
    left_out: Collection[str] = () if exact else MEASURED
    yield from _facts(one.situation, other.situation, left_out)
    twins = {node.path: node for node in other.nodes}
    differ = [
        (node, twin)
        for node in one.nodes
        if (twin := twins.get(node.path)) is not None
        and (node.status != twin.status or (exact and node.message != twin.message))
    ]
    for node, twin in differ:
        if not any(inner.path.startswith(f"{node.path}/") for inner, _ in differ):
            yield Aspect(node.path, _words(node), _words(twin), behaviour=True)


def _words(node: NodeState) -> str:
    return f"{node.status} {node.message}".strip()


def outcome_aspects(one: Outcome, other: Outcome, *, exact: bool) -> Iterator[Aspect]:
    """The differences between two outcomes, apart from `OF_THE_RUN`.

    Unless `exact`, reason, candidates and tasks do not count either.
    """
    left_out = {*OF_THE_RUN, *(() if exact else ("reason", "candidates", "tasks"))}
    names = [one.name for one in fields(Outcome)]
    mine, theirs = ({n: getattr(outcome, n) for n in names} for outcome in (one, other))
    for aspect in _facts(mine, theirs, left_out):
        yield Aspect(f"outcome {aspect.what}", aspect.one, aspect.other)


def parting(one: Run, other: Run) -> Parting | None:
    """The first difference between two recorded missions; None if all decisions are the same.

    Messages and measured values do not count.
    """
    time_s = 0.0
    for a, b in zip_longest(one.ticks(), other.ticks()):
        if a is None or b is None:
            return _longer(a, b)
        time_s = a.time_s
        if aspects := tuple(tick_aspects(a.value, b.value, exact=False)):
            return Parting(a.value.number, time_s, aspects)
    mine, theirs = one.outcome(), other.outcome()
    if mine is None or theirs is None:
        if mine is theirs:
            return None
        ends = (o.status if o else "the recording ends early" for o in (mine, theirs))
        return Parting(None, time_s, (Aspect("outcome", *ends),))
    aspects = tuple(outcome_aspects(mine, theirs, exact=False))
    return Parting(None, time_s, aspects) if aspects else None


def _longer(a: At[Tick] | None, b: At[Tick] | None) -> Parting:
    last = a or b
    assert last is not None
    sides = (f"{at.value.cause}, then {at.value.tip}" if at else ENDED for at in (a, b))
    return Parting(last.value.number, last.time_s, (Aspect("mission", *sides),))


def _facts(
    one: Mapping[str, Any], other: Mapping[str, Any], left_out: Collection[str]
) -> Iterator[Aspect]:
    """Values that differ, after conversion to JSON."""
    for name, value in one.items():
        if name in left_out or name not in other or value is other[name]:
            continue
        texts = [json.dumps(v, default=_plain) for v in (value, other[name])]
        if texts[0] != texts[1]:
            yield Aspect(name, *texts)


def _plain(value: Any) -> Any:
    return asdict(value) if hasattr(value, "__dataclass_fields__") else str(value)


def aspects_text(aspects: Iterable[Aspect], names: tuple[str, str]) -> str:
    """Three lines for each difference: its name, and the (shortened) value on each side."""
    width = max(len(name) for name in names)
    return "\n".join(
        f"  {printable(aspect.what)}\n"
        + "\n".join(
            f"    {name:{width}}  {_begin(printable(value or '-'))}"
            for name, value in zip(names, (aspect.one, aspect.other), strict=True)
        )
        for aspect in aspects
    )


def _begin(text: str) -> str:
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]} ... (all: --json)"
