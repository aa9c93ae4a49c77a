"""Missions in which everything may go wrong: `python tests/benchmarks/bench_soak.py`.

Random missions in the instant world, drawn from seeds: faults of the world, collaborators that
raise, hang and talk nonsense, odd people, models that write garbage, stops at random moments. With
`--physics` they run in PyBullet, with `--stops` the whole program is started and told to stop, and
with `--wire` the robot is served, and driven over a wire that delays, cuts, halves and reorders.
After each the invariants of tests/helpers/soaking are checked. What is violated is printed with its
seed: `--seed SEED --missions 1` runs that household again.
"""

import argparse
import sys
import tempfile
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from statistics import median
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

import faulted_wire
from progress import measure
from soaking.case import missions_of, run_household
from soaking.physics import run_in_physics
from soaking.stops import stop_once

from executive.errors import ExecutiveError

Row = dict[str, Any]
TRIES = 3


def run_instant(trial: Row) -> Row:
    """Run one household in the instant world."""
    return {"violations": run_household(trial["seed"], trial["missions"])}


def run_physics(trial: Row) -> Row:
    """Run one mission in PyBullet."""
    return {"violations": run_in_physics(trial["seed"])}


def run_stop(trial: Row) -> Row:
    """Start the program and stop it."""
    return asdict(stop_once(trial["seed"]))


def run_wire(trial: Row) -> Row:
    """Run some missions over a bad wire.

    On a machine that is very busy, a session may not hear of its robot in time: it tries again.
    """
    seed = trial["seed"]
    for _ in range(TRIES):
        with tempfile.TemporaryDirectory() as folder:
            try:
                came = faulted_wire.missions(seed, Path(folder))
            except ExecutiveError as error:
                why = f"{seed}: it does not begin: {error}"
            else:
                return {
                    "violations": came.faults,
                    "stops": came.stops,
                    "reconnections": came.reconnections,
                }
    return {"violations": [why]}


def households(missions: int, seed: int) -> list[Row]:
    """As many households from this seed on as it takes for so many missions."""
    trials: list[Row] = []
    while missions > 0:
        some = min(missions, missions_of(seed))
        trials.append({"seed": seed, "missions": some})
        missions, seed = missions - some, seed + 1
    return trials


def tell_times(what: str, times: list[float]) -> None:
    """Print a line (s)."""
    if times:
        print(f"{what}: median {median(times):.2f}, worst {max(times):.2f}, of {len(times)}")


def main() -> int:
    """Soak; 1 if anything was violated."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--missions", type=int, default=1000, metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="S")
    parser.add_argument("--workers", type=int, default=2, metavar="N")
    parser.add_argument("--journal", type=Path, metavar="FILE", help="to go on where it was")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--physics", action="store_true", help="in PyBullet")
    where.add_argument("--stops", action="store_true", help="the program in PyBullet, stopped")
    where.add_argument("--wire", action="store_true", help="over a bad wire")
    options = parser.parse_args()
    trials = [
        {"seed": seed, "missions": 1}
        for seed in range(options.seed, options.seed + options.missions)
    ]
    run: Callable[[Row], Row] = run_stop if options.stops else run_physics
    if options.wire:
        some = range(options.seed, options.seed + -(-options.missions // faulted_wire.MISSIONS))
        trials = [{"seed": seed, "missions": faulted_wire.MISSIONS} for seed in some]
        run = run_wire
    elif not (options.physics or options.stops):
        trials, run = households(options.missions, options.seed), run_instant
    with tempfile.TemporaryDirectory() as folder:
        journal = options.journal or Path(folder) / "journal.jsonl"
        rows = measure(trials, run, journal, workers=options.workers)
    violations = [line for row in rows for line in row["violations"]]
    for line in violations:
        print(line)
    if options.stops:
        for what in ("rest_s", "exit_s"):
            tell_times(what, [row[what] for row in rows if row[what] is not None])
    if options.wire:
        for what in ("stops", "reconnections"):
            tell_times(f"{what}, to rest", [time for row in rows for time in row.get(what, ())])
    done = sum(row["missions"] for row in rows)
    print(f"{done} missions, {len(violations)} violations")
    return 1 if violations or done < options.missions else 0


if __name__ == "__main__":
    sys.exit(main())
