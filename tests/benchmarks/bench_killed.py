"""Missions killed at random moments: `python tests/benchmarks/bench_killed.py [--kills 5]`.

Each is a physics mission in a process of its own, killed (SIGKILL) at a random moment after its
first tick. Prints for each what was lost, in seconds of wall time and records, and whether the mcap
was made whole again, replays, and the rrd streams.
"""

import argparse
import random
import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

from rerun.chunk import RrdReader

from executive.replay.replaying import replay
from logs.recording.reader import Run
from logs.recording.recovery import recover

LONGEST_S = 5.0
MISSION = r"""
import io, os, sys, time
from pathlib import Path
from executive.app.session import Session
from executive.config import Settings
from executive.records import EventTaken, Tick, Transforms
session = Session(
    Settings(knowledge="okb", defaults=False, user="oracle", runs=Path(sys.argv[1])),
    out=io.StringIO(),
)
record = session.recorder.record
made = os.open(sys.argv[2], os.O_WRONLY | os.O_CREAT)

def note(entry):
    record(entry)
    if isinstance(entry, EventTaken | Tick | Transforms):
        os.write(made, b"%d %.9f\n" % (time.time_ns(), session.parts.clock.now()))
    if isinstance(entry, Tick) and entry.number == 0:
        print("ticked", flush=True)

session.recorder.record = note
session.run("Bring a sugar_box")
time.sleep(60)
"""


def kill_one(folder: Path, after_s: float) -> tuple[Path, list[tuple[int, float]]]:
    """Run a mission and kill it; its recording, and when each record was made (wall, mission)."""
    made = folder / "made"
    command = [sys.executable, "-c", MISSION, str(folder / "runs"), str(made)]
    mission = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    assert mission.stdout is not None
    with mission.stdout as ticked:
        ticked.readline()
        time.sleep(after_s)
        mission.kill()
        mission.wait()
    (run,) = (folder / "runs").iterdir()
    lines = (line.split() for line in made.read_text().splitlines())
    return run, [(int(wall), float(now)) for wall, now in lines]


def lost_s(run: Run, made: list[tuple[int, float]]) -> float:
    """Wall time from the first record that cannot be read to the last that was made (s)."""
    last = run.last_time_s()
    lost = [wall for wall, now in made if now > last + 1e-6]
    return (lost[-1] - lost[0]) / 1e9 if lost else 0.0


def main() -> None:
    """Print a line for each kill, then median and worst."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--kills", type=int, default=5)
    arguments.add_argument("--seed", type=int, default=0)
    options = arguments.parse_args()
    moments = random.Random(options.seed)
    losses = []
    for _ in range(options.kills):
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            after_s = moments.uniform(0.0, LONGEST_S)
            path, made = kill_one(Path(folder), after_s)
            lost = lost_s(Run(path), made)
            whole = Run(recover(path / "mission.mcap")).whole
            chunks = sum(1 for _ in RrdReader(path / "mission.rrd").stream())
            again = replay(path)
            losses.append(lost)
            print(
                f"killed after {after_s:4.1f} s: {lost:.2f} s lost; recovered: {whole}; "
                f"{again.ticks} ticks replay: {again.parting is None}; {chunks} chunks of the rrd"
            )
    print(f"lost: median {statistics.median(losses):.2f} s, worst {max(losses):.2f} s")


if __name__ == "__main__":
    main()
