"""What the robot costs, beside another commit: `python tests/benchmarks/bench_all.py WORKTREE`.

WORKTREE is a git worktree of the other commit. Both are run in turn by this Python, round by round;
of each figure the least of all rounds counts. Most of them are processor time (user and system),
which other programs on the machine disturb far less than wall time. Prints the tables of
docs/performance.md, with what bounds each figure from below.
"""

import argparse
import compileall
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import bench_stop
from paired import HERE, Pair, alone, head, line, name_of, paired, row, spent, told
from progress import measure

from executive.campaign.report.paper import COMMANDS
from kb.ontology.ontology import Ontology
from sim.home.home_file import load_home

ORDER = "Bring a sugar_box"
DOORS = ("executive", "executive.campaign", "kb", "kb.benchmark", "logs", "sim", "trees")

SESSION = """
import io, time
from contextlib import closing
try: from executive import Session, load_settings
except ImportError:  # where it was before
    from executive.app import Session
    from executive.config import load_settings
def session(**given):
    settings = load_settings(user="oracle", runs={runs!r}, **given)
    return closing(Session(settings, out=io.StringIO()))
"""
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
WATCHED = """
from collections import Counter
spent = Counter()
def watch(owner, name):
    do = getattr(owner, name)
    def timed(*given, **named):
        began = time.thread_time()
        try: return do(*given, **named)
        finally: spent[name] += time.thread_time() - began
    setattr(owner, name, timed)
"""
PHYSICS = """
{session}{watched}
with session(llm="none") as opened:
    for name in ("stepSimulation", "getCameraImage"): watch(opened.world._client, name)
    began = time.thread_time()
    opened.run("{order}")
    print(time.thread_time() - began, spent["stepSimulation"], spent["getCameraImage"])
"""
NINE = """
{session}
took, done = [], 0
with session(llm="embedded") as opened:
    for words in {commands!r}:
        began = time.perf_counter()
        done += opened.run(words).status == "done"
        took.append(time.perf_counter() - began)
print(max(took), sum(took) / done, done)
"""
LOOP = """
{session}{watched}
from executive.loop import Executive
from trees.tree import MissionTree
with session(world="fake", llm="none") as opened:
    opened.run("{order}")
    watch(Executive, "_tick"), watch(MissionTree, "tick")
    for words in {commands!r}: opened.run(words)
print(spent["_tick"] / spent["tick"])
"""
RANKING = """
import time
from contextlib import closing
from executive.events import Inbox
from kb.advice.ranker import Ranker
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.options import ModelOptions
from kb.ontology.ontology import Ontology
from sim.home.home_file import load_home
inbox, known = Inbox(), Ontology(load_home("four_rooms").places(), defaults=True)
def now(): return time.process_time(), time.perf_counter()
def since(before): return [now - then for now, then in zip(now(), before)]
began = now()
with closing(LlamaCpp(embedded_model(), inbox, ModelOptions())) as model:
    model.count_tokens("wait until it is loaded")
    loading, began = since(began), now()
    model.rank(Ranker(known).ranking("{thing}", ()))
    inbox.wait(None)
    ranking = since(began)
(ended,) = inbox.take_all()
print(*ranking, *loading, ended.result.usage.evaluated_tokens)
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


def program(text: str, runs: str = "", **given: object) -> tuple[str, str]:
    """The arguments for a program."""
    parts = {"bench": BENCH, "session": SESSION.format(runs=runs), "watched": WATCHED}
    return "-c", text.format(order=ORDER, commands=COMMANDS, **parts, **given)


def repeated(text: str, times: int, **given: object) -> tuple[str, str]:
    """The arguments for a program that is repeated in one process."""
    _, filled = program(text, **given)
    return "-c", REPEAT.format(program=filled, times=times)


def command(runs: str, *options: str) -> tuple[str, ...]:
    """The arguments for a command of its own."""
    return ("-m", "executive", "--user", "oracle", "--runs", runs, *options, ORDER)


def rows(other: Path, rounds: int, runs: str) -> Iterator[str]:
    """What commands and missions cost, a line at a time."""
    yield head(("what", name_of(other), name_of(HERE), "ratio", "bounded by"))
    settings = alone("from pydantic import BaseModel", rounds)
    for door in DOORS:
        bound = "Python" if door in ("kb", "logs", "trees") else f"pydantic: {settings:.2f} s"
        helped = paired(other, rounds, "-m", door, "--help")
        yield row(f"`python -m {door} --help`", helped, "s", bound)
    libraries = alone(IMPORTS, rounds)
    inside = paired(other, rounds, *program(PHYSICS, runs), inside=True)
    steps, pictures = inside.ours[1:]
    bounds = {
        "fake": f"imports: {libraries:.2f} s",
        "physics": f"imports and PyBullet: {libraries + steps + pictures:.2f} s",
    }
    for world, bound in bounds.items():
        for llm in ("none", "embedded"):
            took = paired(other, rounds, *command(runs, "--world", world, "--llm", llm))
            what = f"command, {world}, model: {llm}"
            yield row(what, took, "s", bound)
            yield row(f"{what}, wall time", took, index=1)
            yield row(f"{what}, most memory of its processes", took, "MiB", index=2)
    bound = f"PyBullet's steps {steps:.2f} s, pictures {pictures:.2f} s"
    yield row("a mission in physics, on the thread that ticks", inside, "s", bound)
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


def session_rows(other: Path, runs: str) -> Iterator[str]:
    """What a session and a campaign cost, measured once on each side, by the clock."""
    nine = paired(other, 1, *program(NINE, runs), inside=True)
    yield row("the paper's nine commands in one session, physics: the slowest", nine)
    yield row("the same, wall time for each that was done", nine, index=1)
    yield row("the same, how many were done", nine, "", index=2)
    loop = paired(other, 1, *program(LOOP, runs), inside=True)
    yield row("a tick with all about it, of the tree's own", loop, "", "1")
    for world, seeds in (("physics", 1), ("ideal", 3)):
        given = ("--systems", "okb+llm", "--seeds", str(seeds), "--workers", "2")
        sides = []
        for tree in (other, HERE):
            out = Path(runs, f"{world}-{len(tree.parts)}-{tree.name}")
            took = spent(tree, "-m", "executive.campaign", f"--{world}", *given, "--out", str(out))
            number = len((out / "journal.jsonl").read_text("utf-8").splitlines()) if took else 0
            sides.append((60 * number / took.wall_s,) if took else ())
        yield row(f"missions a minute, {world}, two workers", Pair(*sides), "a minute")


def own_rows(runs: str) -> Iterator[str]:
    """What the other commit cannot be asked, or not so."""
    things = Ontology(load_home("four_rooms").places(), defaults=True).objects()
    cache = {"EXECUTIVE_CACHE": f"{runs}/cache"}
    first, *later = (spent(HERE, *program(RANKING, thing=t), environment=cache) for t in things[:6])
    costs = [one.printed for one in later if one]
    if first and costs:
        cpu_s, wall_s, loading_cpu_s, loading_s, tokens = map(min, zip(*costs, strict=True))
        ranked = f"{cpu_s:.2f} s; {wall_s:.2f} s by the clock"
        loaded = f"{loading_cpu_s:.2f} s; {loading_s:.2f} s by the clock"
        what = "first ranking of a process, default locations"
        yield line(what, "-", ranked, "-", f"{tokens:.0f} tokens")
        yield line("loading the model before it", "-", loaded, "-", "")
        yield line("first ranking of all", "-", told(first.printed[0], "s"), "-", "")


def stop_row(stops: int, runs: str) -> str:
    """From a stop until the robot is at rest."""
    trials = [{"seed": seed} for seed in range(stops)]
    found = measure(trials, bench_stop.stop_once, Path(runs, "stops.jsonl"))
    rests = [one["rest_s"] for one in found if one["doing"] is not None]
    what = f"stop to rest, worst of {len(rests)} random moments, wall time"
    return line(what, "-", told(max(rests), "s"), "-", "braking")


def test_row() -> str:
    """All tests, as `./check` runs them."""
    workers = str(2 * (os.cpu_count() or 1))
    began = time.perf_counter()
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-n", workers, "--dist", "worksteal"],
        cwd=HERE,
        capture_output=True,
        text=True,
        check=False,
    )
    minutes = (time.perf_counter() - began) / 60
    counted = re.findall(r"\d+ (?:passed|failed|skipped)", ran.stdout)
    return line(f"all tests: {', '.join(counted)}", "-", f"{minutes:.1f} min", "-", "")


def main() -> None:
    """Print the tables."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("worktree", type=Path, help="of the commit to compare with")
    arguments.add_argument("--rounds", type=int, default=5, help="of each figure (default: 5)")
    arguments.add_argument("--stops", type=int, default=200, help="(default: 200; half an hour)")
    arguments.add_argument("--tests", action="store_true", help="run all tests, too")
    given = arguments.parse_args()
    other = given.worktree.resolve()
    for tree in (other, HERE):
        compileall.compile_dir(tree, quiet=2)
    with tempfile.TemporaryDirectory() as runs:
        for text in rows(other, given.rounds, runs):
            print(text, flush=True)
        for text in chain(session_rows(other, runs), own_rows(runs)):
            print(text, flush=True)
        if given.stops:
            print(stop_row(given.stops, runs), flush=True)
    if given.tests:
        print(test_row(), flush=True)


if __name__ == "__main__":
    main()
