"""Long measurements that can be stopped and gone on with: one JSON line for each trial that ended.

Beside the line a word on standard error says how many are done and how long the rest will take.
"""

import json
import sys
import time
from collections.abc import Callable, Iterable
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from executive.shell import leave_stopping_to_the_parent

Row = dict[str, Any]
TRIALS = 100
"""After so many a process is replaced: what rerun keeps of each recording adds up."""


def measure(
    trials: Iterable[Row],
    run: Callable[[Row], Row],
    journal: Path,
    limit_s: float | None = None,
    workers: int = 1,
) -> list[Row]:
    """Run what the journal does not have yet; return all of these trials that it has.

    Args:
        trials: what to try; each row is a trial's name.
        run: tries one; returns what came of it. A function of a module: workers import it.
        journal: a file of JSON lines, made if it is not there.
        limit_s: stop after so long (seconds of wall time).
        workers: processes to run them in.
    """
    wanted = [json.dumps(trial) for trial in trials]
    done = _read(journal)
    left = [trial for trial in wanted if trial not in done]
    began = time.monotonic()
    try:
        pool_of = get_context("spawn").Pool
        with pool_of(workers, leave_stopping_to_the_parent, maxtasksperchild=TRIALS) as pool:
            ended = pool.imap_unordered(partial(_try, run), left)
            for number, (trial, result) in enumerate(ended, start=1):
                done[trial] = result
                with journal.open("a") as file:
                    file.write(json.dumps([json.loads(trial), result]) + "\n")
                left_s = (time.monotonic() - began) / number * (len(left) - number)
                _tell(len(wanted) - len(left) + number, len(wanted), left_s)
                if limit_s is not None and time.monotonic() - began > limit_s:
                    break
    except KeyboardInterrupt:
        print("\nstopped; the same command goes on", file=sys.stderr)
    print(file=sys.stderr)
    return [{**json.loads(trial), **done[trial]} for trial in wanted if trial in done]


def _try(run: Callable[[Row], Row], trial: str) -> tuple[str, Row]:
    return trial, run(json.loads(trial))


def _tell(count: int, total: int, left_s: float) -> None:
    print(f"\r{count} of {total}, {left_s / 60:.0f} min left ", end="", file=sys.stderr)


def _read(journal: Path) -> dict[str, Row]:
    if not journal.exists():
        return {}
    lines = (json.loads(line) for line in journal.read_text().splitlines())
    return {json.dumps(trial): result for trial, result in lines}
