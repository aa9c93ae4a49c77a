"""Long measurements that can be stopped and gone on with: one JSON line for each trial that ended.

Beside the line a word on standard error says how many are done and how long the rest will take.
"""

import json
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

Row = dict[str, Any]


def measure(
    trials: Iterable[Row], run: Callable[[Row], Row], journal: Path, limit_s: float | None = None
) -> list[Row]:
    """Run what the journal does not have yet; return all of these trials that it has.

    Args:
        trials: what to try; each row is a trial's name.
        run: tries one; returns what came of it.
        journal: a file of JSON lines, made if it is not there.
        limit_s: begin no more trials after so long (seconds of wall time).
    """
    wanted = [json.dumps(trial) for trial in trials]
    done = _read(journal)
    left = [trial for trial in wanted if trial not in done]
    began = time.monotonic()
    try:
        for number, trial in enumerate(left, start=1):
            if limit_s is not None and time.monotonic() - began > limit_s:
                break
            done[trial] = run(json.loads(trial))
            with journal.open("a") as file:
                file.write(json.dumps([json.loads(trial), done[trial]]) + "\n")
            left_s = (time.monotonic() - began) / number * (len(left) - number)
            count = len(wanted) - len(left) + number
            print(
                f"\r{count} of {len(wanted)}, {left_s / 60:.0f} min left ", end="", file=sys.stderr
            )
    except KeyboardInterrupt:
        print("\nstopped; the same command goes on", file=sys.stderr)
    print(file=sys.stderr)
    return [{**json.loads(trial), **done[trial]} for trial in wanted if trial in done]


def _read(journal: Path) -> dict[str, Row]:
    if not journal.exists():
        return {}
    lines = (json.loads(line) for line in journal.read_text().splitlines())
    return {json.dumps(trial): result for trial, result in lines}
