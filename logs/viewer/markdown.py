"""Markdown documents in the viewer: the calls of the model, the belief, the outcome."""

import re
from collections.abc import Iterable, Mapping
from textwrap import shorten
from typing import Any

from executive.records import LlmCall, Verified
from executive.text import counted, printable
from executive.types.knowledge import Candidate
from executive.types.llm import Message
from executive.types.outcome import Outcome
from executive.types.results import Replied, Scored
from logs.viewer.states import State, states

_ACTIVE = re.compile(r"[\\`*<|~]|(?<=[!\]])[\[(:]")
"""Characters that could make a picture, a link, HTML or a table; they get a backslash."""
DOTS = 10
GIST_LENGTH = 300

_HEADS = ("| | place | probability | says |", "|---|---|---|---|")
_MARKS = {
    State.OPEN: "",
    State.CURRENT: "▶",
    State.EMPTY: "✗",
    State.BEEN: "•",
    State.UNREACHED: "✗",
    State.FOUND: "✓",
}


def llm_call(call: LlmCall, verified: Verified | None = None) -> str:
    """One call: request, reply, and the result of the verification."""
    result, usage = call.result, call.result.usage
    parts = [
        f"### {plain(result.request.label)}",
        f"**Asked** {_gist(result.request.messages[-1].content)}",
    ]
    if isinstance(result, Replied):
        parts.append(f"**Answered** {_gist(result.text)}")
    else:
        parts.append(_scores(result))
    if verified is not None:
        parts += _verification(verified)
    parts += [
        f"{plain(usage.model)} · {usage.total_s:.2f} s · {usage.input_tokens} tokens in "
        f"({usage.evaluated_tokens} evaluated, {usage.prepared_tokens} before it was asked) · "
        f"{usage.output_tokens} out"
        + "".join(f" · {plain(name)} {plain(v)}" for name, v in usage.parameters.items()),
        "---",
        "### The whole exchange",
        *_turns(result.request.messages),
    ]
    if isinstance(result, Replied):
        parts += _turns([Message("assistant", result.text)])
    return "\n\n".join(parts)


def belief(situation: dict[str, Any]) -> str:
    """Where the thing may be, the source of each place, and its state.

    Args:
        situation: the snapshot in each tick.
    """
    heading = f"### Looking for: {plain(situation.get('object') or 'the thing')}\n\n"
    if planned := _planned(situation):
        return heading + planned
    candidates = [
        Candidate(c["place"], c["source"], c["probability"])
        for c in situation.get("candidates") or ()
    ]
    if not candidates:
        return heading + "No place is known yet."
    marks = {place: _MARKS[state] for place, state in states(situation).items()}
    return heading + _candidates(candidates, marks)


def _planned(situation: Mapping[str, Any]) -> str:
    """The belief behind the plan; empty if there is none."""
    known = situation.get("belief") or {}
    marks = {place: _MARKS[state] for place, state in states(situation).items()}
    rows = [
        f"| {marks.get(one['place'], '')} | {plain(one['place'])} "
        f"| {_probability(one['probability'])} | {plain(_shares(one['shares']))} |"
        for one in known.get("places") or ()
    ]
    if not rows:
        return ""
    elsewhere = f"| | elsewhere | {_probability(known['elsewhere'])} | |"
    return "\n".join([*_HEADS, *rows, elsewhere])


def _shares(shares: Mapping[str, float]) -> str:
    return ", ".join(f"{source} {probability:.2f}" for source, probability in shares.items())


def outcome(outcome: Outcome) -> str:
    """How the mission ended, and what it took."""
    parts = [f"### {plain(outcome.command)}: {outcome.status.replace('_', ' ')}"]
    if outcome.reason:
        parts.append(plain(outcome.reason))
    if outcome.location:
        parts.append(f"Found: **{plain(outcome.location)}** (says {outcome.source})")
    parts.append(
        f"{outcome.mission_time_s:.1f} s, of them {outcome.thinking_time_s:.1f} s thinking · "
        f"{counted(outcome.llm_calls, 'call')} of the model · "
        f"{counted(outcome.inquiries, 'question')}"
    )
    marks = dict.fromkeys(outcome.visited, _MARKS[State.EMPTY if outcome.object else State.BEEN])
    if outcome.location:
        marks[outcome.location] = _MARKS[State.FOUND]
    if outcome.candidates:
        parts.append(_candidates(outcome.candidates, marks))
    return "\n\n".join(parts)


def plain(text: object) -> str:
    """Text from outside as one line without markup, so that no picture is fetched or drawn."""
    return _ACTIVE.sub(r"\\\g<0>", printable(text))


def _candidates(candidates: Iterable[Candidate], marks: Mapping[str, str]) -> str:
    rows = [
        f"| {marks.get(c.place, '')} | {plain(c.place)} | {_probability(c.probability)} "
        f"| {plain(c.source)} |"
        for c in candidates
    ]
    return "\n".join([*_HEADS, *rows])


def _scores(scored: Scored) -> str:
    ranked = sorted(
        zip(scored.scores, scored.request.places, scored.request.options, strict=True), reverse=True
    )
    rows = ["| score | place | as the model read it |", "|---:|---|---|"]
    rows += [
        f"| {score:.2f} | {plain(place)} | {plain(option)} |" for score, place, option in ranked
    ]
    return "\n".join(rows)


def _verification(verified: Verified) -> list[str]:
    rows = (
        ("✓ In this home", verified.accepted),
        ("▶ Rooms, to be expanded", verified.rooms),
        ("✗ Dropped, not in this home", verified.dropped),
    )
    return [f"**{what}** {plain(', '.join(names))}" for what, names in rows if names]


def _turns(messages: Iterable[Message]) -> list[str]:
    return [f"**{plain(m.role)}**\n\n{_quote(m.content)}" for m in messages]


def _quote(text: str) -> str:
    return "\n".join(f"> {plain(line)}  " for line in text.splitlines())


def _gist(text: str) -> str:
    """The text on one line, shortened."""
    return plain(shorten(text, GIST_LENGTH, placeholder=" …"))


def _probability(probability: float | None) -> str:
    if probability is None:
        return ""
    return f"{'●' * round(probability * DOTS)} {probability:.0%}"
