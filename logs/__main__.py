"""`python -m logs`: questions to recorded missions."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import gc
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from executive.errors import InputError
from executive.shell import entry_point
from executive.text import counted, printable
from executive.usage import Parser

if TYPE_CHECKING:  # what answers is heavy: not for --help or a wrong option
    from logs.questions.report import Row
    from logs.recording.reader import At, Run

T = TypeVar("T")


class Answer(NamedTuple):
    """Answer to a question: data, printable text, and exit status (1: incomplete, or different)."""

    data: Any
    text: str
    status: int = 0


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Answer one question; return the exit status (2: bad input)."""
    options = _parser().parse_args(arguments)
    if "run" in options:
        options.run = _chosen(options.run)
    ask: Callable[[argparse.Namespace], Answer] = options.ask
    answer = ask(options)
    print(json.dumps(answer.data, default=str) if options.json else answer.text)
    return answer.status


def _chosen(named: Sequence[Path]) -> Path:
    """The run to ask about; unless the names mean a single run, print which one was chosen."""
    from logs.recording.choice import newest

    chosen = newest(named)
    if chosen.why:
        print(f"{printable(chosen.run)}: {chosen.why}", file=sys.stderr)
    return chosen.run


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="python -m logs",
        description="Questions to recorded missions.",
        epilog="exit: 0 answered, 1 compare or replay: not the same, export or replay: of several "
        "runs some could not be read, 2 bad usage or input",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def add(name: str, ask: Callable[[argparse.Namespace], Answer], what: str, *runs: str) -> Any:
        command = commands.add_parser(name, help=what, description=what)
        command.set_defaults(ask=ask)
        for run in runs:
            command.add_argument(run, type=Path, metavar=run.upper(), help="a run's folder")
        command.add_argument("--json", action="store_true", help="answer as JSON")
        return command

    def add_for_one(
        name: str, ask: Callable[[argparse.Namespace], Answer], what: str, run: str = ""
    ) -> Any:
        command = add(name, ask, what)
        means = f"a run's folder{run}; of several the newest (default: the newest in runs/)"
        command.add_argument("run", nargs="*", type=Path, metavar="RUN", help=means)
        return command

    summary = add("summary", _summary, "how missions ended, and what they took")
    summary.add_argument(
        "runs", nargs="+", type=Path, metavar="RUN", help="a run's folder, or a folder of runs"
    )
    add_for_one("why", _why, "the chain from words to deed: decisions, sources, alternatives")
    add_for_one("ticks", _ticks, "each tick: its events, and the behaviours that it changed")
    when = add_for_one("timeline", _timeline, "which behaviours ran when (mission time, s)")
    when.add_argument("--svg", type=Path, metavar="FILE", help="draw it, too")
    add_for_one("llm", _llm, "calls of the language model and their verification")
    add_for_one("dialog", _dialog, "what was said")
    frames = add_for_one("frames", _frames, "write the camera's pictures")
    frames.add_argument(
        "--out", type=Path, required=True, metavar="DIR or FILE.mp4", help="files, or a video"
    )
    frames.add_argument("--png", action="store_true", help="PNG files (default: JPEG, as recorded)")
    tables = add("export", _export, "write Parquet tables: runs, ticks, behaviours, events, ...")
    tables.add_argument(
        "runs", nargs="+", type=Path, metavar="RUN", help="a run, or a folder of runs"
    )
    tables.add_argument("--parquet", type=Path, required=True, metavar="DIR", help="where to")
    add("compare", _compare, "where two missions part", "one", "other")
    again = add("replay", _replay, "feed recorded events to a fresh tree: are its ticks the same?")
    means = "a run's folder, or a folder of runs (default: the newest in runs/)"
    again.add_argument("runs", nargs="*", type=Path, metavar="RUN", help=means)
    view = add_for_one("view", _view, "show the mission in the rerun viewer")
    view.add_argument("--web", action="store_true", help="in the browser, served to this machine")
    view.add_argument("--png", type=Path, metavar="FILE", help="instead, a picture of the viewer")
    view.add_argument("--at", type=float, default=0.0, metavar="S", help="at this mission time")
    mends = "write a broken mcap file whole again, as far as it reads"
    add_for_one("recover", _recover, mends, ", or its mcap file")
    return parser


def _opened(folder: Path) -> "Run":
    from logs.recording.reader import Run

    return Run(folder)


def _summary(options: argparse.Namespace) -> Answer:
    from logs.questions import report

    rows = list(_each(options.runs, lambda run: report.summary(_opened(run))))
    return Answer(rows, report.summary_text(rows))


def _each(folders: Sequence[Path], ask: Callable[[Path], T]) -> "Iterator[T | Row]":
    """One answer for each run; among several, an unreadable one gives a row with the error."""
    from logs.recording.choice import runs_in
    from logs.recording.reader import FILE_NAME

    for run in runs_in(folders):
        try:
            yield ask(run)
        except InputError as error:
            if [run] == list(folders):
                raise
            yield {"run": run.name, "error": str(error).removeprefix(f"{run / FILE_NAME}: ")}


def _why(options: argparse.Namespace) -> Answer:
    from logs.questions.decision import why_text
    from logs.questions.why import why

    run = _opened(options.run)
    decisions = why(run)
    return Answer([asdict(decision) for decision in decisions], _told(run, why_text(decisions)))


def _told(run: "Run", text: str) -> str:
    """The answer, and that the recording ends early, if it does."""
    return text if run.whole else f"{text}\nthe recording ends early"


def _ticks(options: argparse.Namespace) -> Answer:
    from logs.questions import report

    run = _opened(options.run)
    rows = report.ticks(run)
    return Answer(rows, _told(run, report.ticks_text(rows)))


def _timeline(options: argparse.Namespace) -> Answer:
    from logs.questions import gantt, report

    run = _opened(options.run)
    spans = report.timeline(run)
    if options.svg:
        _write(options.svg, gantt.svg(spans).encode(), options.run)
    return Answer([asdict(span) for span in spans], _told(run, report.timeline_text(spans)))


def _write(file: Path, data: bytes, run: Path) -> None:
    """Write a file; refuse to overwrite the recording itself."""
    from logs.recording.recovery import written

    if file.exists() and any(file.samefile(of) for of in (run, *run.glob("mission.*"))):
        raise InputError(str(file), "is the recording itself", "name another file")
    with written(file) as new:
        new.write(data)


def _llm(options: argparse.Namespace) -> Answer:
    from logs.questions import report

    run = _opened(options.run)
    rows = report.llm(run)
    return Answer(rows, _told(run, report.llm_text(rows)))


def _dialog(options: argparse.Namespace) -> Answer:
    from logs.questions import report

    run = _opened(options.run)
    rows = report.dialog(run)
    return Answer(rows, _told(run, report.dialog_text(rows)))


def _frames(options: argparse.Namespace) -> Answer:
    from logs.questions import pictures

    run, out = _opened(options.run), options.out
    where = printable(out)
    if out.suffix == ".mp4":
        count = pictures.write_video(_Frames(run), out)
        return Answer(
            [str(out)], f"{counted(count, 'picture')}, {count / pictures.VIDEO_HZ:g} s, in {where}"
        )
    files = pictures.write_files(run.frames(), out, png=options.png)
    return Answer([str(file) for file in files], f"{counted(len(files), 'picture')} in {where}")


class _Frames:
    """The pictures of a run; can be iterated more than once."""

    def __init__(self, run: "Run") -> None:
        self._run = run

    def __iter__(self) -> "Iterator[At[bytes]]":
        return self._run.frames()


def _export(options: argparse.Namespace) -> Answer:
    from logs.questions.export import write_parquet
    from logs.recording.choice import runs_in

    runs = list(runs_in(options.runs))
    exported = write_parquet(runs, options.parquet)
    if runs == options.runs[:1] and exported.unread:
        raise exported.unread[0]
    for error in exported.unread:
        print(f"left out: {printable(error)}", file=sys.stderr)
    for run in exported.early:
        print(f"{printable(run)}: ends early, exported as far as it reads", file=sys.stderr)
    return Answer(
        [str(file) for file in exported.files],
        "\n".join(map(printable, exported.files)),
        int(bool(exported.unread)),
    )


def _compare(options: argparse.Namespace) -> Answer:
    from logs.questions import comparison

    compared = comparison.compare(_opened(options.one), _opened(options.other))
    return Answer(
        asdict(compared), comparison.compare_text(compared), int(compared.parting is not None)
    )


def _replay(options: argparse.Namespace) -> Answer:
    from executive.replay import Replay, replay, replay_text, replays_text

    gc.freeze()  # what is imported stays; to look through it for garbage takes a tenth of a second
    answers = list(_each(options.runs or [_chosen(())], replay))
    replays = [answer for answer in answers if isinstance(answer, Replay)]
    unread = [answer for answer in answers if not isinstance(answer, Replay)]
    lines = [*map(replay_text, replays)]
    lines += [printable(f"{row['run']}: {row['error']}") for row in unread]
    if len(replays) > 1:
        lines.append(replays_text(replays))
    same = not unread and all(replayed.parting is None for replayed in replays)
    return Answer([*map(asdict, replays), *unread], "\n".join(lines), int(not same))


def _recover(options: argparse.Namespace) -> Answer:
    from logs.recording.reader import mcap_of
    from logs.recording.recovery import first_damage, recover

    file = mcap_of(options.run)
    recovered, damage = recover(file), first_damage(file)
    where = "nothing was missing"
    if damage:
        where = f"{file} does not read at byte {damage[0]}: {damage[1].what}"
    return Answer(
        {"recovered": str(recovered), "damaged_at": damage[0] if damage else None},
        printable(f"recovered: {recovered}; {where}"),
    )


def _view(options: argparse.Namespace) -> Answer:
    from logs.viewer import program

    recording = options.run / "mission.rrd" if options.run.is_dir() else options.run
    if not recording.is_file() or recording.suffix not in (".rrd", ".mcap"):
        raise InputError(str(options.run), "holds no mission.rrd", "name a run's folder")
    if options.png:
        _write(options.png, program.picture(recording, options.at), options.run)
        return Answer(str(options.png), printable(options.png))
    program.show(recording, web=options.web)
    return Answer(str(recording), printable(f"shown: {recording}"))


if __name__ == "__main__":
    sys.exit(main())
