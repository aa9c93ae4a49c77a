"""`python -m logs`: questions to recorded missions."""

import argparse
import json
import sys
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

from executive.errors import ExecutiveError, InputError
from logs import report, viewer
from logs.reader import Run
from logs.recovery import recover


def main(arguments: list[str] | None = None) -> int:
    """Answer one question; return the exit status (2: bad input)."""
    options = _parser().parse_args(arguments)
    answer: Callable[[argparse.Namespace], str] = options.answer
    try:
        print(answer(options))
    except ExecutiveError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m logs", description="Questions to recorded missions."
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def add(
        name: str, answer: Callable[[argparse.Namespace], str], what: str
    ) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=what, description=what)
        command.set_defaults(answer=answer)
        return command

    summary = add("summary", _summary, "how each mission ended, and what it took")
    summary.add_argument("runs", nargs="+", type=Path, metavar="RUN", help="a run's folder")
    timeline = add("timeline", _timeline, "which behaviours ran when (from, to: mission time, s)")
    llm = add("llm", _llm, "calls of the language model and their verification")
    dialog = add("dialog", _dialog, "what was said")
    frames = add("frames", _frames, "write the camera's pictures as JPEG files")
    view = add("view", _view, "show the mission in the rerun viewer")
    for command in (timeline, llm, dialog, frames, view):
        command.add_argument("run", type=Path, metavar="RUN", help="a run's folder")
    for command in (summary, timeline, llm, dialog):
        command.add_argument("--json", action="store_true", help="answer as JSON")
    frames.add_argument(
        "--out", type=Path, required=True, metavar="DIR", help="where to write them"
    )
    mend = add("recover", _recover, "write a broken mcap file whole again, as far as it reads")
    mend.add_argument("file", type=Path, metavar="FILE")
    return parser


def _summary(options: argparse.Namespace) -> str:
    rows = [report.summary(Run(run)) for run in options.runs]
    return json.dumps(rows) if options.json else report.summary_text(rows)


def _timeline(options: argparse.Namespace) -> str:
    spans = report.timeline(Run(options.run))
    if options.json:
        return json.dumps([asdict(span) for span in spans])
    return report.timeline_text(spans)


def _llm(options: argparse.Namespace) -> str:
    rows = report.llm(Run(options.run))
    return json.dumps(rows) if options.json else report.llm_text(rows)


def _dialog(options: argparse.Namespace) -> str:
    rows = report.dialog(Run(options.run))
    return json.dumps(rows) if options.json else report.dialog_text(rows)


def _frames(options: argparse.Namespace) -> str:
    run = Run(options.run)
    options.out.mkdir(parents=True, exist_ok=True)
    count = 0
    for count, at in enumerate(run.frames(), start=1):
        (options.out / f"{count:05}-{at.time_s:.3f}s.jpg").write_bytes(at.value)
    return f"{count} pictures in {options.out}"


def _recover(options: argparse.Namespace) -> str:
    return f"recovered: {recover(options.file)}"


def _view(options: argparse.Namespace) -> str:
    recording = options.run / "mission.rrd" if options.run.is_dir() else options.run
    if not recording.is_file():
        raise InputError(str(options.run), "holds no mission.rrd", "name a run's folder")
    viewer.show(recording)
    return f"shown: {recording}"


if __name__ == "__main__":
    sys.exit(main())
