"""What the robot costs, beside another commit: `python tests/benchmarks/bench_all.py WORKTREE`.

WORKTREE is a git worktree of the other commit. Both are run in turn by this Python, round by round,
and what is told is processor time (user and system), which other programs on the machine disturb
far less than wall time. Of each figure the least of all rounds counts. Prints the table of
docs/performance.md, with what bounds each figure from below.
"""

import argparse
import compileall
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parents[2]
ORDER = "Bring a sugar_box"
DOORS = ("executive", "executive.campaign", "kb", "kb.benchmark", "logs", "sim", "trees")

BENCH = """
import sys
try: from executive.testing.bench import run_mission
except ImportError:  # where it was before
    sys.path.insert(0, "tests")
    from conftest import run_mission
"""
MISSION = """
{bench}
def once(): return run_mission("{order}")
"""
TICK = """
from statistics import median
{bench}
def figure(): return median(tick.duration_s for tick in run_mission("{order}").ticks)
"""
REPLAY = """
from pathlib import Path
from executive.replay import replay
def once(): return replay(Path({recording!r}))
"""
IDEAL = """
from executive.campaign.blocks import Block, run
from executive.config import load_settings
def once(): return list(run(Block(load_settings(world="fake", llm="none", user="oracle"), (
    "{order}", "Bring a mug", "Find an apple", "Bring a banana"))))
share = 4
"""
PHYSICS = """
import time, sys, io
from executive import Session, load_settings
spent = dict.fromkeys(("stepSimulation", "getCameraImage"), 0.0)
def watched(do, name):
    def timed(*given, **named):
        began = time.thread_time()
        try: return do(*given, **named)
        finally: spent[name] += time.thread_time() - began
    return timed
settings = load_settings(llm="none", user="oracle", runs={runs!r})
with Session(settings, out=io.StringIO()) as session:
    client = session.world._client
    for name in spent: setattr(client, name, watched(getattr(client, name), name))
    began = time.thread_time()
    session.run("{order}")
    print(time.thread_time() - began, *spent.values())
"""
IMPORTS = "import numpy, rdflib, lark, py_trees, pyarrow, cv2, mcap, rerun"

REPEAT = """
import time
share = 1
{program}
def timed():
    began = time.process_time()
    once()
    return (time.process_time() - began) / share
if "figure" not in globals(): figure = timed
figure()
print(min(figure() for _ in range({times})))
"""
"""Runs a program's `once`, or reads its `figure`, warm."""


@dataclass(frozen=True)
class Spent:
    """What one process took: processor time (s), most memory (MiB), and what it printed."""

    cpu_s: float
    memory: float
    printed: tuple[float, ...]


def spent(tree: Path, *arguments: str) -> Spent | None:
    """Run this Python in a worktree, whose packages come before what is installed.

    None if that does not work, as where the other commit has something elsewhere.
    """
    with tempfile.TemporaryFile("w+") as out:
        environment = {**os.environ, "PYTHONPATH": str(tree)}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)  # nobody compiles each time
        process = subprocess.Popen(
            [sys.executable, *arguments],
            cwd=tree,
            env=environment,
            stdout=out,
            stderr=subprocess.DEVNULL,
        )
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            return None
        out.seek(0)
        printed = out.read() if arguments[0] == "-c" else ""
    numbers = tuple(float(word) for word in printed.split())
    return Spent(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, numbers)


def repeated(program: str, times: int, **given: str) -> tuple[str, str]:
    """The arguments for a program that is repeated in one process."""
    filled = program.format(order=ORDER, bench=BENCH, **given)
    return "-c", REPEAT.format(program=filled, times=times)


def command(runs: str, *options: str) -> tuple[str, ...]:
    """The arguments for a command of its own."""
    return ("-m", "executive", "--user", "oracle", "--runs", runs, *options, ORDER)


@dataclass(frozen=True)
class Pair:
    """Both sides of what was measured; no figures where it does not work."""

    other: tuple[float, ...]
    ours: tuple[float, ...]


def paired(other: Path, rounds: int, *arguments: str, inside: bool = False) -> Pair:
    """The least of several rounds: processor time and memory, or what was printed (`inside`)."""
    found: dict[Path, list[tuple[float, ...]]] = {other: [], HERE: []}
    for number in range(rounds):
        for tree in (other, HERE) if number % 2 == 0 else (HERE, other):
            if (one := spent(tree, *arguments)) is None:
                continue
            found[tree].append(one.printed if inside else (one.cpu_s, one.memory))
    least = {tree: tuple(map(min, zip(*rows, strict=True))) for tree, rows in found.items()}
    return Pair(least[other], least[HERE])


def alone(program: str, rounds: int) -> float:
    """Processor time (s) of a program that has nothing of ours in it."""
    return min(one.cpu_s for _ in range(rounds) if (one := spent(HERE, "-c", program)))


def row(what: str, pair: Pair, unit: str = "s", bound: str = "", index: int = 0) -> str:
    """A line of the table."""
    scale, digits = {"s": (1.0, 2), "ms": (1000.0, 2), "MiB": (1.0, 0)}[unit]
    figures = [side[index] if side else None for side in (pair.other, pair.ours)]
    told = " | ".join("-" if f is None else f"{f * scale:.{digits}f} {unit}" for f in figures)
    other, ours = figures
    ratio = f"{ours / other:.2f}" if ours and other else "-"
    return f"| {what} | {told} | {ratio} | {bound} |"


def rows(other: Path, rounds: int, runs: str) -> Iterator[str]:
    """The table, a line at a time."""
    yield f"| what | {name_of(other)} | {name_of(HERE)} | ratio | bounded by |"
    yield "|---|---|---|---|---|"
    settings = alone("from pydantic import BaseModel", rounds)
    for door in DOORS:
        bound = "Python" if door in ("kb", "logs", "trees") else f"pydantic: {settings:.2f} s"
        helped = paired(other, rounds, "-m", door, "--help")
        yield row(f"`python -m {door} --help`", helped, "s", bound)
    libraries = alone(IMPORTS, rounds)
    instant = paired(other, rounds, *command(runs, "--world", "fake", "--llm", "none"))
    yield row("command, instant world, no model", instant, "s", f"imports: {libraries:.2f} s")
    physics = paired(other, rounds, *command(runs, "--llm", "none"))
    inside = paired(other, rounds, "-c", PHYSICS.format(runs=runs, order=ORDER), inside=True)
    pure = sum(inside.ours[1:])
    bound = f"imports and PyBullet: {libraries + pure:.2f} s"
    yield row("command, physics, no model", physics, "s", bound)
    bound = f"PyBullet's steps {inside.ours[1]:.2f} s, pictures {inside.ours[2]:.2f} s"
    yield row("its mission, on the thread that ticks", inside, "s", bound)
    thinking = paired(other, rounds, *command(runs))
    yield row("command, physics, embedded model", thinking)
    yield row("most memory of `command, physics, no model`", physics, "MiB", index=1)
    yield row("most memory of `command, physics, embedded model`", thinking, "MiB", index=1)
    yield from repeated_rows(other, rounds, runs)


def repeated_rows(other: Path, rounds: int, runs: str) -> Iterator[str]:
    """What is done many times in one process."""
    mission = paired(other, rounds, *repeated(MISSION, 30), inside=True)
    bound = "its ticks, and building its tree"
    yield row("mission in the instant world, warm", mission, "ms", bound)
    yield row("a tick of it, median", paired(other, rounds, *repeated(TICK, 30), inside=True), "ms")
    spent(other, *command(f"{runs}/kept", "--world", "fake", "--llm", "none"))
    (recording,) = Path(runs, "kept").iterdir()
    again = repeated(REPLAY, 20, recording=str(recording))
    yield row("replay of a recording of it", paired(other, rounds, *again, inside=True), "ms")
    ideal = paired(other, rounds, *repeated(IDEAL, 5), inside=True)
    yield row("mission of an ideal campaign, no model", ideal, "ms", "the mission above")


def name_of(tree: Path) -> str:
    """The commit that a worktree has."""
    asked = ("git", "-C", str(tree), "describe", "--always", "--dirty")
    return subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()


def main() -> None:
    """Print the table."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("worktree", type=Path, help="of the commit to compare with")
    arguments.add_argument("--rounds", type=int, default=5, help="of each figure (default: 5)")
    given = arguments.parse_args()
    for tree in (given.worktree, HERE):
        compileall.compile_dir(tree, quiet=2)
    with tempfile.TemporaryDirectory() as runs:
        for line in rows(given.worktree.resolve(), given.rounds, runs):
            print(line, flush=True)


if __name__ == "__main__":
    main()
