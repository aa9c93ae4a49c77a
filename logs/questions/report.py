"""Reports about recorded missions, as plain data and as text."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from textwrap import shorten
from typing import Any

from executive.records import LlmCall, NodeState, Tick, Verified
from executive.text import counted, printable
from executive.types.results import Replied, Scored
from logs.recording.events import in_words
from logs.recording.reader import At, Run

Row = dict[str, Any]

MESSAGE_LENGTH = 120
"""Maximum length of a behaviour's message on a line (characters)."""


@dataclass(slots=True)
class Span:
    """One run of a behaviour: from the tick that started it to the tick in which it ended.

    `status` is its status after the last of these ticks: RUNNING if the recording ends first;
    INVALID if it was interrupted, or if it failed and a loop reset it in the same tick.
    """

    start_s: float
    end_s: float
    path: str
    status: str
    message: str


def summary(run: Run) -> Row:
    """The outcome, the time of each behaviour, the faults, and the number of ticks and pictures."""
    outcome = run.outcome()
    return {
        "run": run.name,
        "whole": run.whole,
        "ticks": sum(1 for _ in run.ticks()),
        "frames": sum(1 for _ in run.frames()),
        "time_by_behaviour_s": time_split(run),
        "mishaps": [{"time_s": at.time_s, **asdict(at.value)} for at in run.mishaps()],
        "metadata": run.metadata,
        "outcome": asdict(outcome) if outcome else None,
    }


def time_split(run: Run) -> dict[str, float]:
    """Mission time (s) that each behaviour was running, by name, longest first."""
    seconds: dict[str, float] = defaultdict(float)
    for span in timeline(run):
        seconds[span.path.rpartition("/")[2]] += span.end_s - span.start_s
    longest_first = sorted(seconds.items(), key=lambda item: -item[1])
    return {name: round(spent, 3) for name, spent in longest_first if spent > 0}


def ticks(run: Run) -> list[Row]:
    """Each tick: the events that caused it, which behaviour decided, and which ones changed.

    Events that no tick followed, as after a stop, have a row without one.
    """
    rows: list[Row] = []
    before: dict[str, NodeState] = {}
    for turn in run.turns():
        row: Row = {"time_s": turn.time_s, "events": [in_words(event) for event in turn.events]}
        if (tick := turn.tick) is not None:
            changed = [n for n in tick.nodes if _decided(n) != _decided(before.get(n.path))]
            row |= {
                "tick": tick.number,
                "tip": tick.tip,
                "duration_s": tick.duration_s,
                "changed": [asdict(node) for node in changed],
            }
            before = {node.path: node for node in tick.nodes}
        rows.append(row)
    return rows


def _decided(node: NodeState | None) -> str:
    return node.status if node else "INVALID"


def timeline(run: Run) -> list[Span]:
    """When each leaf of the tree was running, in order of the starts.

    A leaf that decides within one tick has no duration; if it decides the same several times in a
    row, without running in between, it counts once.
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
    """Every call of the language model, with the result of the verification."""
    rows: list[Row] = []
    for at in run.thoughts():
        match at.value:
            case LlmCall(result):
                rows.append({"time_s": at.time_s, **_call(result)})
            case Verified() if rows:
                rows[-1]["verified"] = asdict(at.value)
    return rows


def _call(result: Replied | Scored) -> Row:
    row: Row = {
        "label": result.request.label,
        **asdict(result.usage),
        "messages": [asdict(message) for message in result.request.messages],
    }
    match result:
        case Replied(text=text, finish_reason=reason):
            row |= {"reply": text, "finish_reason": reason}
        case Scored(request=request, scores=scores):
            row["scores"] = dict(zip(request.places, scores, strict=True))
    return row


def dialog(run: Run) -> list[Row]:
    """What was said, by whom and when."""
    return [{"time_s": at.time_s, **asdict(at.value)} for at in run.dialog()]


# --- as text ---


def summary_text(rows: Sequence[Row]) -> str:
    """One run in words; several as a table."""
    if len(rows) == 1:
        return _in_words(rows[0])
    return table([_cells(row) for row in rows])


def _in_words(row: Row) -> str:
    size = f"{counted(row['ticks'], 'tick')}, {counted(row['frames'], 'frame')}"
    outcome = row["outcome"]
    name = printable(row["run"])
    if outcome is None:
        why = "" if row["whole"] else " (the recording ends early)"
        return f"{name}: no outcome{why}; {size}"
    where = f" in {outcome['location']} (says {outcome['source']})" if outcome["location"] else ""
    reason = f": {outcome['reason']}" if outcome["reason"] else ""
    split = ", ".join(f"{what} {spent:.1f}" for what, spent in row["time_by_behaviour_s"].items())
    lines = [
        f"{name}: {outcome['command']!r} {outcome['status']}{where}{reason}",
        f"    {outcome['mission_time_s']:.1f} s, "
        f"of them {outcome['thinking_time_s']:.1f} s thinking; "
        f"{counted(outcome['llm_calls'], 'call')} of the model, "
        f"{counted(outcome['inquiries'], 'question')}, "
        f"{counted(len(outcome['visited']), 'place')} visited; {size}",
        f"    seconds by behaviour: {split or 'none'}",
        *(f"    {m['time_s']:.1f} s {m['fault']}: {m['text']}" for m in row["mishaps"]),
    ]
    return "\n".join(map(printable, lines))


def _cells(row: Row) -> Row:
    """A run as a row of the table."""
    outcome = row.get("outcome") or {}
    status = row.get("error") or outcome.get("status") or "no outcome"
    return {
        "run": row["run"],
        "command": outcome.get("command"),
        "status": status if row.get("whole", True) else f"{status}, ends early",
        "source": outcome.get("source"),
        "location": outcome.get("location"),
        "visited": len(outcome["visited"]) if outcome else None,
        "asked": outcome.get("inquiries"),
        "llm": outcome.get("llm_calls"),
        "ticks": row.get("ticks"),
        "frames": row.get("frames"),
        "thinking_s": outcome.get("thinking_time_s"),
        "mission_s": outcome.get("mission_time_s"),
        "wall_s": outcome.get("wall_time_s"),
    }


def table(rows: Sequence[Row]) -> str:
    """Rows with the same keys as a table with headings; numbers are right-aligned."""
    if not rows:
        return ""
    names = list(rows[0])
    texts = [names] + [[_cell(row[name]) for name in names] for row in rows]
    widths = [max(len(line[i]) for line in texts) for i in range(len(names))]
    right = [all(isinstance(row[n], int | float | None) for row in rows) for n in names]
    return "\n".join(
        "  ".join(
            text.rjust(width) if is_number else text.ljust(width)
            for text, width, is_number in zip(line, widths, right, strict=True)
        ).rstrip()
        for line in texts
    )


def _cell(value: Any) -> str:
    if value is None:
        return "-"
    return f"{value:.1f}" if isinstance(value, float) else printable(value)


def ticks_text(rows: Iterable[Row]) -> str:
    """A line for each tick and its cause, and one for each behaviour that it changed."""
    return "\n".join(map(_tick_text, rows)) or "nothing happened: the recording has no ticks"


def _tick_text(row: Row) -> str:
    number = f"{row['tick']:4}" if "tick" in row else "   -"
    lines = [f"{row['time_s']:9.3f} {number}  {'; '.join(row['events'])}"]
    lines += [
        f"{'':16}{node['status']:8} {node['path']}"
        + (f"  ({_one_line(node['message'])})" if node["message"] else "")
        for node in row.get("changed", ())
    ]
    return "\n".join(map(printable, lines))


def _one_line(text: str) -> str:
    return shorten(text, MESSAGE_LENGTH, placeholder=" …")


def timeline_text(spans: Iterable[Span]) -> str:
    """A line for each span: from, to, status, behaviour, message."""
    lines = (
        f"{s.start_s:9.3f} {s.end_s:9.3f}  {s.status:8} {printable(s.path)}"
        + (f"  ({printable(_one_line(s.message))})" if s.message else "")
        for s in spans
    )
    return "\n".join(lines) or "no behaviour ran: the recording has no ticks"


def llm_text(rows: Iterable[Row]) -> str:
    """A paragraph for each call."""
    return "\n\n".join(map(_call_text, rows)) or "no call of the model"


def _call_text(row: Row) -> str:
    usage = f"{row['input_tokens']} -> {row['output_tokens']} tokens"
    lines = [
        printable(f"{row['time_s']:.3f} s  {row['label']}  {row['model']}  ")
        + f"{row['total_s']:.2f} s  {usage}",
        *_paragraph("asked", row["messages"][-1]["content"]),
    ]
    if row["prepared_tokens"]:
        lines.append(f"  prepared  {row['prepared_tokens']} tokens in {row['prepared_s']:.2f} s")
    if "reply" in row:
        lines += _paragraph("answered", row["reply"])
    else:
        ranked = sorted(row["scores"].items(), key=lambda item: -item[1])
        scores = ", ".join(f"{place} {score:.2f}" for place, score in ranked)
        lines += _paragraph("scored", scores)
    for part in ("accepted", "rooms", "dropped"):
        if row.get("verified", {}).get(part):
            lines += _paragraph(part, ", ".join(row["verified"][part]))
    return "\n".join(lines)


def _paragraph(title: str, text: str) -> list[str]:
    """A title with its text; further lines are indented behind a bar, which no text can imitate."""
    first, *others = (printable(line) for line in text.replace("\r\n", "\n").split("\n"))
    return [f"  {title:9} {first}", *(f"{'':10}| {line}" for line in others)]


def dialog_text(rows: Iterable[Row]) -> str:
    """A line for each utterance."""
    lines = (f"{row['time_s']:9.3f}  {row['speaker']:6}  {row['text']}" for row in rows)
    return "\n".join(map(printable, lines)) or "nothing was said"
