"""A mission that is killed leaves recordings that read, less the last second at most."""

import subprocess
import sys
import time
from pathlib import Path

import pytest
from rerun.chunk import RrdReader
from rerun.error_utils import RerunWarning

from executive.replay.replaying import replay
from logs.recording.reader import Run
from logs.recording.recovery import recover

SLOW_MISSION = r"""
import io, itertools, os, sys, time
from contextlib import suppress
from pathlib import Path
from executive.app.session import Session
from executive.config import Settings
from executive.records import EventTaken, Tick
session = Session(
    Settings(world="fake", knowledge="okb", user="oracle", runs=Path(sys.argv[1])),
    out=io.StringIO(),
)
advance, record = session.world.advance, session.recorder.record
made = os.open(sys.argv[2], os.O_WRONLY | os.O_CREAT)  # survives, as no buffer holds it

steps, waits, tasks = itertools.count(), {}, Path("/proc/self/task")

def slowly(at_most):
    time.sleep(0.6 if next(steps) < 6 else 600)
    return advance(at_most)

def undisturbed_ns():  # without the time in which the machine was busy with something else
    for task in tasks.iterdir() if tasks.exists() else ():
        with suppress(OSError):
            waits[task] = int((task / "schedstat").read_text().split()[1])
    return time.time_ns() - sum(waits.values())

def note(entry):
    record(entry)
    if isinstance(entry, EventTaken | Tick):
        os.write(made, b"%d\n" % undisturbed_ns())
    if isinstance(entry, Tick) and entry.number == 0:
        print("ticked", flush=True)

session.world.advance, session.recorder.record = slowly, note
session.run("Bring an apple")
"""


@pytest.mark.parametrize("moment_s", [0.05, 0.6, 1.3, 1.9])
def test_whatever_the_moment_both_files_read_and_a_whole_one_is_made(
    tmp_path: Path, moment_s: float
) -> None:
    made = tmp_path / "last"
    mission = subprocess.Popen(
        [sys.executable, "-c", SLOW_MISSION, str(tmp_path / "runs"), str(made)],
        stdout=subprocess.PIPE,
    )
    assert mission.stdout is not None
    with mission.stdout as ticked:
        ticked.readline()
        time.sleep(moment_s)
        mission.kill()
        mission.wait()
    (folder,) = (tmp_path / "runs").iterdir()
    run = Run(folder)
    assert not run.whole
    assert lost_s(run, made) < 1.2
    assert replay(folder).parting is None
    whole = Run(recover(folder / "mission.mcap"))
    assert whole.whole
    assert len(list(whole.ticks())) == len(list(run.ticks()))
    with pytest.warns(RerunWarning, match="no footer"):
        assert list(RrdReader(folder / "mission.rrd").stream())


def lost_s(run: Run, made: Path) -> float:
    """From the first event or tick that cannot be read to the last that was made (s).

    What other programs took of the machine meanwhile is not in it.
    """
    times_ns = [int(line) for line in made.read_text().split()]
    read = sum(len(turn.events) + (turn.tick is not None) for turn in run.turns())
    lost = times_ns[read:]
    return (lost[-1] - lost[0]) / 1e9 if lost else 0.0
