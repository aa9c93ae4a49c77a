"""Exports recorded missions as Parquet tables, for pandas, polars or DuckDB.

Every table has the column `run`; rows can be joined on it with `tick` or `time_s` (mission time,
s).
"""

import json
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field
from itertools import chain, islice
from pathlib import Path
from tempfile import TemporaryDirectory

import pyarrow as pa
import pyarrow.parquet as pq

from executive.errors import InputError
from executive.events import Ended
from logs.questions import report
from logs.recording.events import gist
from logs.recording.reader import Run

Row = report.Row

ROWS = 10_000
"""Rows in memory at a time."""


@dataclass(slots=True)
class Exported:
    """The result of an export."""

    files: list[Path] = field(default_factory=list)
    unread: list[InputError] = field(default_factory=list)
    """For each run that is in no table, why."""
    early: list[Path] = field(default_factory=list)
    """Runs that end early; they are in the tables as far as they can be read."""


def write_parquet(folders: Iterable[Path], folder: Path) -> Exported:
    """Write `runs`, `ticks`, `behaviours`, `events`, `llm_calls` and `dialog` `.parquet`.

    A table without rows is omitted. The tables appear when all are complete. An unreadable run
    does not affect the others.

    Raises:
        InputError: if the folder cannot be written.
    """
    exported = Exported()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=folder, prefix=".tables") as unfinished:
            names = _write(folders, Path(unfinished), exported)
            exported.files = [(Path(unfinished) / name).replace(folder / name) for name in names]
    except OSError as error:
        raise InputError(str(folder), f"cannot be written: {error.strerror or error}") from error
    return exported


def _write(folders: Iterable[Path], folder: Path, exported: Exported) -> list[str]:
    """Write the tables; return the names of those that have rows."""
    files = {name: f"{name}.parquet" for name in TABLES}
    with ExitStack() as open_tables:
        writers: dict[str, pq.ParquetWriter] = {}
        for run_folder in folders:
            try:
                run = _readable(run_folder)
            except InputError as error:
                exported.unread.append(error)
                continue
            if not run.whole:
                exported.early.append(run_folder)
            for name, (rows_of, columns) in TABLES.items():
                schema = pa.schema([("run", pa.string()), *columns])
                for rows in _batches({"run": run.name, **row} for row in rows_of(run)):
                    if name not in writers:
                        writers[name] = open_tables.enter_context(
                            pq.ParquetWriter(folder / files[name], schema, compression="zstd")
                        )
                    writers[name].write_table(pa.Table.from_pylist(rows, schema))
    return [files[name] for name in TABLES if name in writers]


def _readable(folder: Path) -> Run:
    """Open a run and read it once completely, so that no table contains part of a damaged run."""
    run = Run(folder)
    for _ in chain.from_iterable(rows_of(run) for rows_of, _ in TABLES.values()):
        pass
    return run


def _batches(rows: Iterator[Row]) -> Iterator[list[Row]]:
    return iter(lambda: list(islice(rows, ROWS)), [])


def _runs(run: Run) -> Iterator[Row]:
    outcome = run.outcome()
    yield {
        "whole": run.whole,
        "started": run.metadata["started"],
        "metadata": json.dumps(run.metadata),
        "config": run.attachments.get("config.toml", b"").decode(errors="replace"),
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


_STRINGS = pa.list_(pa.string())
_CANDIDATE = {"place": pa.string(), "source": pa.string(), "probability": pa.float64()}
_PART = {
    **dict.fromkeys(("kind", "target", "object", "status", "reason", "location"), pa.string()),
    **dict.fromkeys(("goals", "visited", "things", "among"), _STRINGS),
}
_TASK = {**_PART, "parts": pa.list_(pa.struct(_PART))}
_VERIFIED = {
    "label": pa.string(),
    "accepted": _STRINGS,
    "rooms": _STRINGS,
    "dropped": _STRINGS,
}
_MESSAGE = {"role": pa.string(), "content": pa.string()}

Columns = list[tuple[str, pa.DataType]]


def _columns(**types: pa.DataType) -> Columns:
    return list(types.items())


TABLES: dict[str, tuple[Callable[[Run], Iterable[Row]], Columns]] = {
    "runs": (
        _runs,
        _columns(
            whole=pa.bool_(),
            started=pa.string(),
            metadata=pa.string(),
            config=pa.string(),
            command=pa.string(),
            kind=pa.string(),
            target=pa.string(),
            object=pa.string(),
            status=pa.string(),
            reason=pa.string(),
            source=pa.string(),
            location=pa.string(),
            inquiries=pa.int64(),
            visited=_STRINGS,
            llm_calls=pa.int64(),
            candidates=pa.list_(pa.struct(_CANDIDATE)),
            mission_time_s=pa.float64(),
            thinking_time_s=pa.float64(),
            wall_time_s=pa.float64(),
            run_dir=pa.string(),
            model_failure=pa.string(),
            goals=_STRINGS,
            tasks=pa.list_(pa.struct(_TASK)),
        ),
    ),
    "ticks": (
        _ticks,
        _columns(
            tick=pa.int64(),
            time_s=pa.float64(),
            cause=pa.string(),
            tip=pa.string(),
            duration_s=pa.float64(),
            situation=pa.string(),
        ),
    ),
    "behaviours": (
        _behaviours,
        _columns(
            tick=pa.int64(),
            time_s=pa.float64(),
            path=pa.string(),
            status=pa.string(),
            message=pa.string(),
        ),
    ),
    "events": (
        _events,
        _columns(
            time_s=pa.float64(),
            name=pa.string(),
            request=pa.int64(),
            result=pa.string(),
            text=pa.string(),
        ),
    ),
    "llm_calls": (
        _llm_calls,
        _columns(
            reply=pa.string(),
            finish_reason=pa.string(),
            verified=pa.struct(_VERIFIED),
            time_s=pa.float64(),
            label=pa.string(),
            model=pa.string(),
            input_tokens=pa.int64(),
            evaluated_tokens=pa.int64(),
            output_tokens=pa.int64(),
            first_token_s=pa.float64(),
            total_s=pa.float64(),
            prepared_tokens=pa.int64(),
            prepared_s=pa.float64(),
            messages=pa.list_(pa.struct(_MESSAGE)),
            scores=pa.string(),
            parameters=pa.string(),
        ),
    ),
    "dialog": (
        report.dialog,
        _columns(time_s=pa.float64(), speaker=pa.string(), text=pa.string()),
    ),
}
"""For each table: its name, a function for the rows of one run, and its columns without `run`."""
