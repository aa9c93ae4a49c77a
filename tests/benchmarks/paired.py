"""The same thing done in two worktrees in turn, by this Python, and what each time of it cost."""

import os
import select
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import psutil

HERE = Path(__file__).parents[2]
LOOK_S = 0.1
"""How often memory is looked at (s)."""
SCALES = {"s": (1.0, 2), "ms": (1000.0, 2), "MiB": (1.0, 0), "a minute": (1.0, 0), "": (1.0, 2)}
"""By unit: what a figure is multiplied with, and its digits."""


@dataclass(frozen=True)
class Spent:
    """What a process took, and what it printed."""

    cpu_s: float
    """Processor time, user and system, of it and of those that it waited for."""
    wall_s: float
    memory: float
    """The most that it and its processes had at a time (MiB); what they share is counted once."""
    printed: tuple[float, ...]


@dataclass(frozen=True)
class Pair:
    """The same figures of both sides; none where it does not work, as where a commit lacks it."""

    other: tuple[float, ...]
    ours: tuple[float, ...]


def spent(
    tree: Path, *arguments: str, environment: Mapping[str, str] | None = None
) -> Spent | None:
    """Run this Python in a worktree, whose packages come before what is installed.

    Returns:
        None if that does not work.
    """
    with tempfile.TemporaryFile("w+") as out:
        around = {**os.environ, "PYTHONPATH": str(tree), **(environment or {})}
        around.pop("PYTHONDONTWRITEBYTECODE", None)  # nobody compiles each time
        began = time.perf_counter()
        process = subprocess.Popen(
            [sys.executable, *arguments],
            cwd=tree,
            env=around,
            stdout=out,
            stderr=subprocess.DEVNULL,
        )
        memory, end = 0.0, os.pidfd_open(process.pid)
        while not select.select([end], [], [], LOOK_S)[0]:
            memory = max(memory, _memory(process.pid))
        wall_s = time.perf_counter() - began
        os.close(end)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            return None
        out.seek(0)
        printed = out.read() if arguments[0] == "-c" else ""
    numbers = tuple(float(word) for word in printed.split())
    return Spent(used.ru_utime + used.ru_stime, wall_s, memory, numbers)


def _memory(pid: int) -> float:
    """What a process and its processes have in memory, each its share of what is shared (MiB)."""
    found = 0
    try:
        process = psutil.Process(pid)
        for one in (process, *process.children(recursive=True)):
            found += one.memory_full_info().pss
    except psutil.NoSuchProcess:  # it ended meanwhile
        pass
    return found / 2**20


def paired(
    other: Path,
    rounds: int,
    *arguments: str,
    inside: bool = False,
    environment: Mapping[str, str] | None = None,
) -> Pair:
    """The least of several rounds: processor time, wall time and memory, or what is printed."""
    found: dict[Path, list[tuple[float, ...]]] = {other: [], HERE: []}
    for number in range(rounds):
        for tree in (other, HERE) if number % 2 == 0 else (HERE, other):
            if (one := spent(tree, *arguments, environment=environment)) is None:
                continue
            found[tree].append(one.printed if inside else (one.cpu_s, one.wall_s, one.memory))
    least = {tree: tuple(map(min, zip(*rows, strict=True))) for tree, rows in found.items()}
    return Pair(least[other], least[HERE])


def alone(program: str, rounds: int) -> float:
    """Processor time (s) of a program that has nothing of ours in it."""
    return min(one.cpu_s for _ in range(rounds) if (one := spent(HERE, "-c", program)))


def row(what: str, pair: Pair, unit: str = "s", bound: str = "", index: int = 0) -> str:
    """A line of a table."""
    figures = [side[index] if side else None for side in (pair.other, pair.ours)]
    other, ours = figures
    ratio = f"{ours / other:.2f}" if ours and other else "-"
    return line(what, *(told(figure, unit) for figure in figures), ratio, bound)


def told(figure: float | None, unit: str) -> str:
    """A figure with its unit."""
    scale, digits = SCALES[unit]
    return "-" if figure is None else f"{figure * scale:.{digits}f} {unit}".rstrip()


def line(*cells: str) -> str:
    """A line of a table, of its cells."""
    return f"| {' | '.join(cells)} |"


def head(cells: Sequence[str]) -> str:
    """The first two lines of a table."""
    return line(*cells) + "\n|" + "---|" * len(cells)


def name_of(tree: Path) -> str:
    """The commit that a worktree has."""
    asked = ("git", "-C", str(tree), "describe", "--always", "--dirty")
    return subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()
