"""What can be said about recorded missions, as plain data and as text."""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from executive.records import Tick
from executive.types import Replied, Scored
from logs.reader import At, Run

Row = dict[str, Any]


@dataclass(slots=True)
class Span:
    """One behaviour at work: from the tick that started it to the tick that saw it end.

    `status` is how the last of these ticks left it: RUNNING if the recording ends first, INVALID if
    it was interrupted, or failed and was reset within the tick because a loop went on.
    """

    start_s: float
    end_s: float
    path: str
    status: str
    message: str


def summary(run: Run) -> Row:
    """The outcome, and how much there is to see."""
    outcome = run.outcome()
    name = run.path.parent.name if run.path.stem == "mission" else run.path.name
    return {
        "run": name,
        "whole": run.whole,
        "ticks": sum(1 for _ in run.ticks()),
        "frames": sum(1 for _ in run.frames()),
        "metadata": run.metadata,
        "outcome": asdict(outcome) if outcome else None,
    }


def timeline(run: Run) -> list[Span]:
    """When each leaf of the tree was at work, in order of their starts.

    What decides within one tick has no length; a leaf that decides the same twice in a row, without
    being at work in between, counts once.
    """
    parents = {node.parent for node in run.tree().nodes}
    leaves = {node.path for node in run.tree().nodes} - parents
    spans: list[Span] = []
    running: dict[str, Span] = {}
    before: Mapping[str, str] = {}
    for at in run.ticks():
        for node in at.value.nodes:
            if node.path not in leaves or before.get(node.path, "INVALID") == node.status:
                continue
            span = running.pop(node.path, None)
            if span is None:
                if node.status == "INVALID":
                    continue
                span = Span(at.time_s, at.time_s, node.path, node.status, node.message)
                spans.append(span)
            span.end_s, span.status = at.time_s, node.status
            span.message = node.message or span.message
            if node.status == "RUNNING":
                running[node.path] = span
        before = _statuses(at)
        for span in running.values():
            span.end_s = at.time_s
    return spans


def _statuses(at: At[Tick]) -> dict[str, str]:
    return {node.path: node.status for node in at.value.nodes}


def llm(run: Run) -> list[Row]:
    """Every call of the language model, with what the verification made of it."""
    rows: list[Row] = []
    for at in run.llm_calls():
        result = at.value.result
        row: Row = {
            "time_s": at.time_s,
            "label": result.request.label,
            **asdict(result.usage),
            "messages": [asdict(message) for message in result.request.messages],
        }
        match result:
            case Replied(text=text, finish_reason=reason):
                row |= {"reply": text, "finish_reason": reason}
            case Scored(request=request, scores=scores):
                row["scores"] = dict(zip(request.places, scores, strict=True))
        rows.append(row)
    for verified in run.verifications():
        made_of = [row for row in rows if row["time_s"] <= verified.time_s]
        if made_of:
            made_of[-1]["verified"] = asdict(verified.value)
    return rows


def dialog(run: Run) -> list[Row]:
    """What was said, by whom and when."""
    return [{"time_s": at.time_s, **asdict(at.value)} for at in run.dialog()]


# --- as text ---


def summary_text(rows: Iterable[Row]) -> str:
    """A line for each run."""
    return "\n".join(_summary_line(row) for row in rows)


def _summary_line(row: Row) -> str:
    size = f"{row['ticks']} ticks, {row['frames']} frames"
    outcome = row["outcome"]
    if outcome is None:
        why = "" if row["whole"] else " (the recording ends early)"
        return f"{row['run']}: no outcome{why}; {size}"
    where = f" in {outcome['location']} (says {outcome['source']})" if outcome["location"] else ""
    reason = f": {outcome['reason']}" if outcome["reason"] else ""
    return (
        f"{row['run']}: {outcome['command']!r} {outcome['status']}{where}{reason}\n"
        f"    {outcome['mission_time_s']:.1f} s, "
        f"of them {outcome['thinking_time_s']:.1f} s thinking; "
        f"{outcome['llm_calls']} calls of the model, {outcome['inquiries']} questions, "
        f"{len(outcome['visited'])} places visited; {size}"
    )


def timeline_text(spans: Iterable[Span]) -> str:
    """A line for each span: from, to, status, behaviour, message."""
    return "\n".join(
        f"{s.start_s:9.3f} {s.end_s:9.3f}  {s.status:8} {s.path}"
        + (f"  ({s.message})" if s.message else "")
        for s in spans
    )


def llm_text(rows: Iterable[Row]) -> str:
    """A paragraph for each call."""
    return "\n\n".join(_call_text(row) for row in rows)


def _call_text(row: Row) -> str:
    lines = [
        f"{row['time_s']:.3f} s  {row['label']}  {row['model']}  {row['total_s']:.2f} s  "
        f"{row['input_tokens']} -> {row['output_tokens']} tokens",
        f"  asked     {row['messages'][-1]['content']}",
    ]
    if "reply" in row:
        lines.append(f"  answered  {row['reply']}")
    else:
        ranked = sorted(row["scores"].items(), key=lambda item: -item[1])
        lines.append("  scored    " + ", ".join(f"{place} {score:.2f}" for place, score in ranked))
    for part in ("accepted", "rooms", "dropped"):
        if row.get("verified", {}).get(part):
            lines.append(f"  {part:9} {', '.join(row['verified'][part])}")
    return "\n".join(lines)


def dialog_text(rows: Iterable[Row]) -> str:
    """A line for each utterance."""
    return "\n".join(f"{row['time_s']:9.3f}  {row['speaker']:6}  {row['text']}" for row in rows)
