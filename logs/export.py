"""Recorded missions as Parquet tables, for pandas, polars or DuckDB.

Every table has the column `run`; together with `tick` or `time_s` (mission time) rows join.
"""

import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from executive.errors import InputError
from executive.events import Ended
from logs import report
from logs.event_messages import gist
from logs.reader import Run

Row = report.Row


def write_parquet(runs: Iterable[Run], folder: Path) -> list[Path]:
    """Write `runs`, `ticks`, `behaviours`, `events`, `llm_calls` and `dialog` `.parquet`.

    A table without rows is left out.

    Raises:
        InputError: if the folder cannot be written, or a recording cannot be read.
    """
    runs = list(runs)
    written = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, rows_of in TABLES.items():
            rows = [{"run": run.name, **row} for run in runs for row in rows_of(run)]
            if rows:
                written.append(folder / f"{name}.parquet")
                pq.write_table(pa.Table.from_pylist(rows), written[-1], compression="zstd")
    except OSError as error:
        raise InputError(str(folder), f"cannot be written: {error}") from error
    return written


def _runs(run: Run) -> Iterator[Row]:
    outcome = run.outcome()
    yield {
        "whole": run.whole,
        "started": run.metadata["started"],
        "metadata": json.dumps(run.metadata),
        "config": run.attachments.get("config.toml", b"").decode(),
        **(asdict(outcome) if outcome else {}),
    }


def _ticks(run: Run) -> Iterator[Row]:
    for at in run.ticks():
        tick = at.value
        yield {
            "tick": tick.number,
            "time_s": at.time_s,
            "cause": tick.cause,
            "tip": tick.tip,
            "duration_s": tick.duration_s,
            "situation": json.dumps(tick.situation),
        }


def _behaviours(run: Run) -> Iterator[Row]:
    for at in run.ticks():
        for node in at.value.nodes:
            yield {"tick": at.value.number, "time_s": at.time_s, **asdict(node)}


def _events(run: Run) -> Iterator[Row]:
    for at in run.events():
        ended = at.value if isinstance(at.value, Ended) else None
        yield {
            "time_s": at.time_s,
            "name": type(at.value).__name__,
            "request": ended.request if ended else None,
            "result": type(ended.result).__name__ if ended else None,
            "text": gist(at.value),
        }


def _llm_calls(run: Run) -> Iterator[Row]:
    for row in report.llm(run):
        nested = {name: json.dumps(row.pop(name, None)) for name in ("scores", "parameters")}
        yield {"reply": None, "finish_reason": None, "verified": None, **row, **nested}


TABLES: dict[str, Callable[[Run], Iterable[Row]]] = {
    "runs": _runs,
    "ticks": _ticks,
    "behaviours": _behaviours,
    "events": _events,
    "llm_calls": _llm_calls,
    "dialog": report.dialog,
}
"""Name of each table, and its rows of one run."""
