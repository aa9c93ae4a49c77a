"""What logging costs the mission: `python tests/benchmarks/bench_logging.py`.

Runs the same physics mission with logging off and on, in turns, in this process. Prints what
handing over each kind of record costs the ticking thread, the files' sizes, and the ratio of wall
times. `--run RUN` only prints the sizes of a recording there is.
"""

import argparse
import io
import statistics
import tempfile
import time
from collections import Counter, defaultdict
from pathlib import Path

from mcap.reader import make_reader

from executive.app import recording, session
from executive.config import Settings
from executive.records import Record
from logs.recorder import Sink

COMMAND = "Bring a sugar_box"


class RecordTimes:
    """Times a recorder's `record`, by the kind of record."""

    def __init__(self, session: session.Session) -> None:
        self.seconds: dict[str, list[float]] = defaultdict(list)
        self._record = session.recorder.record
        session.recorder.record = self.record  # type: ignore[method-assign]

    def record(self, record: Record) -> None:
        began = time.perf_counter()
        self._record(record)
        self.seconds[type(record).__name__].append(time.perf_counter() - began)


def settings(runs: Path) -> Settings:
    """A mission that thinks nothing, so that runs compare: the person says where the thing is."""
    return Settings(knowledge="okb", defaults=False, user="oracle", runs=runs)


def mission(runs: Path, *, logged: bool) -> tuple[float, dict[str, list[float]], Path]:
    """Wall time (s), time of each record by kind (s), and the run's folder."""
    working = recording.open_sinks
    if not logged:
        recording.open_sinks = lambda *makers: (list[Sink](), True)
    with session.Session(settings(runs), out=io.StringIO()) as ours:
        watch = RecordTimes(ours)
        outcome = ours.run(COMMAND)
    recording.open_sinks = working
    return outcome.wall_time_s, watch.seconds, Path(outcome.run_dir or "")


def print_records(seconds: dict[str, list[float]]) -> None:
    """A line for each kind: how many, median, 99th percentile, worst."""
    for kind, times in sorted(seconds.items()):
        ordered = sorted(times)
        worst = ordered[-1] * 1e6
        p99 = ordered[int(0.99 * (len(ordered) - 1))] * 1e6
        median = statistics.median(ordered) * 1e6
        print(
            f"  {kind:12} {len(times):5} times  median {median:6.0f} us  "
            f"p99 {p99:6.0f} us  worst {worst:6.0f} us"
        )


def print_sizes(run: Path) -> None:
    """The files, and the mcap by topic (bytes before compression)."""
    for file in sorted(run.iterdir()):
        print(f"  {file.name:14} {file.stat().st_size / 1e6:7.2f} MB")
    sizes: Counter[str] = Counter()
    with (run / "mission.mcap").open("rb") as file:
        for _, channel, message in make_reader(file).iter_messages():
            sizes[channel.topic] += len(message.data)
    for topic, size in sizes.most_common():
        print(f"    {topic:28} {size / 1e6:7.2f} MB")


def main() -> None:
    """What is asked for."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--missions", type=int, default=3, help="with logging, and without")
    arguments.add_argument("--run", type=Path, help="only the sizes of this recording")
    options = arguments.parse_args()
    if options.run:
        print_sizes(options.run)
    else:
        compare(options.missions)


def compare(count: int) -> None:
    """Missions with logging and without, in turns."""
    with tempfile.TemporaryDirectory() as folder:
        on, off = [], []
        for _ in range(count):
            off.append(mission(Path(folder), logged=False)[0])
            wall_s, seconds, run = mission(Path(folder), logged=True)
            on.append(wall_s)
        print(f"'{COMMAND}', the last of {count}: handed over on the ticking thread")
        print_records(seconds)
        print("files")
        print_sizes(run)
    print(f"wall time, logging on:  {', '.join(f'{s:.2f}' for s in on)} s")
    print(f"wall time, logging off: {', '.join(f'{s:.2f}' for s in off)} s")
    medians = statistics.median(on) / statistics.median(off)
    print(f"on / off: fastest {min(on) / min(off):.3f}, medians {medians:.3f}")


if __name__ == "__main__":
    main()
