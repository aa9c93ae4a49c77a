"""Missions that are corrected at random moments: `python tests/benchmarks/bench_corrections.py`.

Each is begun for one thing, and at a random moment the person says that another one is meant. It
has to end with the right thing, and the way driven is held against that of a robot that is stopped
at the same moment, and sent anew: nobody can replan earlier.
"""

import argparse
import io
import math
import random
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from interrupting import Interrupting
from progress import measure

from executive.app.parts import Parts
from executive.app.session import Session
from executive.config import load_settings
from executive.events import THE_PERSON, Event, Heard, Inbox, StopRequested
from executive.records import Record, Transforms
from executive.types.outcome import MissionStatus
from logs.recorder import Stamp

Row = dict[str, Any]
THINGS = ("hammer", "power_drill", "scissors", "mustard_bottle", "sugar_box", "banana")
KINDS = ("find", "take", "bring")
LATEST_S = {"fake": 20.0, "physics": 40.0}
"""Until when something is said (mission time)."""


class Way:
    """A sink that adds up how far the robot drives (m)."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.length_m = 0.0
        self._at: tuple[float, float] | None = None

    def write(self, stamp: Stamp, record: Record) -> None:
        """Go on from where it was."""
        if isinstance(record, Transforms):
            for one in record.transforms:
                if one.child == "base_link":
                    at = one.pose.position[:2]
                    self.length_m += math.dist(self._at or at, at)
                    self._at = at

    def flush(self) -> None:
        """Nothing to do."""

    def close(self) -> None:
        """Nothing to do."""


def run(trial: Row) -> Row:
    """One mission corrected, and the same one stopped and begun anew."""
    chance = random.Random(trial["seed"])
    wrong, right = chance.sample(THINGS, 2)
    kind = chance.choice(KINDS)
    when_s = chance.uniform(0.5, LATEST_S[trial["world"]])
    begin, instead = f"{kind} the {wrong}", f"No, the {right}"
    corrected = _drive(trial, [begin], when_s, Heard(instead))
    stopped = _drive(trial, [begin, f"{kind} the {right}"], when_s, StopRequested(THE_PERSON))
    said = f"{begin}; after {when_s:.1f} s: {instead}"
    return {"said": said, **corrected, "reference_m": stopped["way_m"], "meant": right}


def _drive(trial: Row, words: list[str], when_s: float, event: Event) -> Row:
    way, clocks = Way(), []
    inbox = Inbox()

    def change(parts: Parts) -> Parts:
        clocks.append(Interrupting(parts.clock, inbox, when_s, event))
        return replace(parts, clock=clocks[0])

    settings = load_settings(
        world=trial["world"],
        llm="none",
        user="oracle",
        seed=trial["seed"],
        camera_hz=0.0,
        detector="simulated",
        runs=Path(tempfile.gettempdir()),
    )
    with Session(
        settings, inbox=inbox, out=io.StringIO(), recorded=False, sinks=[way], change=change
    ) as session:
        for said in words:
            outcome = session.run(said)
    return {
        "interrupted": clocks[0].interrupted,
        "object": outcome.object,
        "done": outcome.status == MissionStatus.DONE,
        "reason": outcome.reason,
        "way_m": round(way.length_m, 2),
    }


def main() -> int:
    """Measure; 1 if one ended with another thing than the right one."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--missions", type=int, default=200, metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="S")
    parser.add_argument("--world", choices=("fake", "physics"), default="fake")
    parser.add_argument("--workers", type=int, default=2, metavar="N")
    parser.add_argument("--journal", type=Path, metavar="FILE", help="to go on where it was")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        seeds = range(options.seed, options.seed + options.missions)
        trials = [{"world": options.world, "seed": seed} for seed in seeds]
        journal = options.journal or Path(folder) / "journal"
        rows = measure(trials, run, journal, workers=options.workers)
    heard = [row for row in rows if row["interrupted"]]
    right = [row for row in heard if row["done"] and row["object"] == row["meant"]]
    ratios = sorted(row["way_m"] / row["reference_m"] for row in right if row["reference_m"])
    print(f"{len(rows)} missions, {len(heard)} of them corrected before they ended")
    print(f"ended with the right thing: {len(right)}")
    if ratios:
        total = sum(r["way_m"] for r in right) / sum(r["reference_m"] for r in right)
        ninety = ratios[int(0.95 * len(ratios))]
        print(f"way driven / that of one stopped and sent anew: {total:.3f} of all,")
        print(f"  median {median(ratios):.3f}, 95 % at most {ninety:.3f}, most {ratios[-1]:.3f}")
    for row in heard:
        if row not in right:
            print(f"seed {row['seed']}: {row['said']}: {row['object']}: {row['reason']}")
    return len(right) < len(heard)


if __name__ == "__main__":
    sys.exit(main())
