"""Missions in which everything may go wrong: `python tests/benchmarks/bench_soak.py`.

Random missions in the instant world, drawn from seeds: faults of the world, collaborators that
raise, hang and talk nonsense, odd people, models that write garbage, stops at random moments. After
each the invariants of tests/soaking are checked; what is violated is printed with the seed, and
`--missions 1 --seed SEED` runs that household again.
"""

import argparse
import sys
import tempfile
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))

from progress import measure
from soaking.case import missions_of, run_household


def run(trial: dict[str, Any]) -> dict[str, Any]:
    """Run one household."""
    return {"violations": run_household(trial["seed"], trial["missions"])}


def households(missions: int, seed: int) -> list[dict[str, Any]]:
    """As many households from this seed on as it takes for so many missions."""
    trials: list[dict[str, Any]] = []
    while missions > 0:
        some = min(missions, missions_of(seed))
        trials.append({"seed": seed, "missions": some})
        missions, seed = missions - some, seed + 1
    return trials


def main() -> int:
    """Soak; 1 if anything was violated."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--missions", type=int, default=1000, metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="S")
    parser.add_argument("--workers", type=int, default=2, metavar="N")
    parser.add_argument("--journal", type=Path, metavar="FILE", help="to go on where it was")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        journal = options.journal or Path(folder) / "journal.jsonl"
        trials = households(options.missions, options.seed)
        rows = measure(trials, run, journal, workers=options.workers)
    violations = [line for row in rows for line in row["violations"]]
    for line in violations:
        print(line)
    done = sum(row["missions"] for row in rows)
    print(f"{done} missions, {len(violations)} violations")
    return 1 if violations or done < options.missions else 0


if __name__ == "__main__":
    sys.exit(main())
