"""Sessions of the paper's nine commands in physics: `python tests/benchmarks/bench_session.py`.

How long each mission takes, and what the thread that ticks is at when it hears no stop: of each
cause the longest stretch, of the control periods too. Each session has a seed, which moves and
turns all things a little. Beside wall time, in which other programs on the machine have their part,
stands processor time: of the whole process for a mission, of the thread for a stretch. The first
mission of a process is warm: another one was run before. Ctrl-C stops it; the same command with
the same `--journal` goes on.
"""

import argparse
import atexit
import gc
import io
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from statistics import median
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from progress import Row, measure
from stretches import Stretch, Stretches

from executive import Session, load_settings
from executive.campaign.report.paper import COMMANDS
from executive.shell import all_is_kept
from sim.manipulation import manipulator
from sim.pictures import beside

atexit.register(gc.unfreeze)  # what `all_is_kept` keeps: libraries tell of it at the end

FITTING = "fitting a pose (beside)"
_warm: list[bool] = []


def run_session(trial: Row) -> Row:
    """One session: of each mission what it took, of each cause the longest stretches."""
    if not _warm:
        run_missions({**trial, "missions": 1})
        _warm.append(True)
    return run_missions(trial)


def run_missions(trial: Row) -> Row:
    """The first so many of the commands."""
    missions, fits = [], [0.0]
    fit = manipulator.fit_fallen_pose

    def timed_fit(*given: object) -> object:
        began = time.thread_time()
        try:
            return fit(*given)  # type: ignore[arg-type]
        finally:
            fits.append(time.thread_time() - began)

    with tempfile.TemporaryDirectory() as folder:
        settings = load_settings(user="oracle", llm=trial["llm"], seed=trial["seed"], runs=folder)
        stretches = Stretches()
        as_the_command = mock.patch.object(beside, "worthwhile", return_value=True)
        with all_is_kept(), as_the_command:  # which is no worker and draws pictures beside
            opened = Session(settings, out=io.StringIO())
        with (
            opened as session,
            mock.patch.object(manipulator, "fit_fallen_pose", timed_fit),
            stretches.watching(),
        ):
            for command in COMMANDS[: trial["missions"]]:
                wall, processor = time.perf_counter(), time.process_time()
                outcome = session.run(command)
                wall, processor = time.perf_counter() - wall, time.process_time() - processor
                missions.append([command, str(outcome.status), wall, processor])
    walls, processors = stretches.by_wall, stretches.by_processor
    causes = {cause: [walls[cause].wall_s, processors[cause].processor_s] for cause in processors}
    return {"missions": missions, "causes": causes | {FITTING: [0.0, max(fits)]}}


def trials(missions: int, seed: int, llm: str) -> Iterator[Row]:
    """Sessions of nine missions, until there are so many."""
    while missions > 0:
        yield {"seed": seed, "missions": min(missions, len(COMMANDS)), "llm": llm}
        missions, seed = missions - len(COMMANDS), seed + 1


def table(rows: Iterable[Row]) -> Iterator[str]:
    """What is told of the sessions."""
    rows = list(rows)
    missions = [mission for row in rows for mission in row["missions"]]
    yield f"{len(missions)} missions, {sum(m[1] == 'done' for m in missions)} of them done"
    yield ""
    yield "| command | wall: median, longest | processor: median, longest |"
    yield "|---|---|---|"
    for command in dict.fromkeys(mission[0] for mission in missions):
        times = [mission[2:] for mission in missions if mission[0] == command]
        told = (f"{median(some):.1f} s, {max(some):.1f} s" for some in zip(*times, strict=True))
        yield f"| {command} | {' | '.join(told)} |"
    yield ""
    yield "| no stop is heard during | longest: wall | processor |"
    yield "|---|---|---|"
    found: dict[str, Stretch] = {}
    for row in rows:
        for cause, (wall_s, processor_s) in row["causes"].items():
            before = found.get(cause, Stretch(cause, 0.0, 0.0))
            longest = max(wall_s, before.wall_s), max(processor_s, before.processor_s)
            found[cause] = Stretch(cause, *longest)
    for stretch in sorted(found.values(), key=lambda one: -one.processor_s):
        wall = f"{1e3 * stretch.wall_s:.0f} ms" if stretch.wall_s else "a stop is heard"
        yield f"| {stretch.cause} | {wall} | {1e3 * stretch.processor_s:.1f} ms |"


def main() -> None:
    """Measure, and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--missions", type=int, default=2 * len(COMMANDS), metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of the first session")
    parser.add_argument("--llm", choices=("none", "embedded"), default="none")
    parser.add_argument("--workers", type=int, default=1, metavar="N")
    parser.add_argument("--journal", type=Path, metavar="FILE", help="to go on where it was")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        journal = given.journal or Path(folder) / "journal.jsonl"
        wanted = trials(given.missions, given.seed, given.llm)
        for line in table(measure(wanted, run_session, journal, workers=given.workers)):
            print(line)


if __name__ == "__main__":
    main()
