"""Grasping and placing in physics: `python tests/benchmarks/bench_handling.py`. Ctrl-C stops it.

Every object on every piece of furniture of four_rooms that it can be on, some seeds each (a seed
moves and turns all things a little). The robot starts before the furniture, looks, picks up (up to
three times, each after another look, as in a mission), and puts the thing down on the same piece.
The simulated detector tells what is where in a picture, so that hands are tested and not eyes; the
simulator's truth decides what was held and placed. The same command goes on where it was stopped.
"""

import argparse
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from progress import Row, measure
from scipy.stats import binomtest

from executive.clock import SimulatedClock
from executive.errors import InputError
from executive.events import Inbox
from executive.perception.pipeline import locate
from executive.records import Record
from executive.types.goals import DriveTo, Goal, LookAt, Pick, PutDown
from executive.types.perception import Detection
from executive.types.results import Failed, Result
from sim.home.home_file import load_home
from sim.home.validation import with_placement
from sim.objects.objects import load_objects
from sim.world import PhysicsWorld

HOME = load_home("four_rooms")
TRIES = 3
PATIENCE_S = 120.0
ORDER_SEED = 0


class NoRecorder:
    """Keeps nothing."""

    def record(self, record: Record) -> None:
        """Drop the record."""


class Handler:
    """The robot before a piece of furniture with a thing on it."""

    def __init__(self, thing: str, place: str, seed: int) -> None:
        """Build the world."""
        home = with_placement(HOME, {thing: place})
        home = home.model_copy(update={"robot_start": home.stand(place)})
        self.thing, self.place, self._inbox = thing, place, Inbox()
        self.world = PhysicsWorld(
            home, load_objects(), self._inbox, NoRecorder(), seed=seed, camera_hz=0.0
        )
        self._clock = SimulatedClock(self._inbox, self.world)

    def do(self, goal: Goal) -> Result:
        """Pursue a goal to its end."""
        self.world.robot.start(goal)
        self._clock.wait(self._clock.now() + PATIENCE_S)
        events = self._inbox.take_all()
        return events[-1].result if events else Failed("it took too long")

    def see(self) -> Detection | None:
        """The thing in the first view in which it is; if it is cut off there, looked at again."""
        for view in range(self.world.robot.views(self.place)):
            seen = self._look(LookAt(self.place, view))
            if seen and seen.cut_off:
                seen = self._look(LookAt(self.place, view, seen.position))
            if seen:
                return seen
        return None

    def _look(self, goal: LookAt) -> Detection | None:
        self.do(goal)
        frame = self.world.camera.capture()
        things = self.world.detector.detect(frame)
        return next((locate(d, frame) for d in things if d.label == self.thing), None)

    def pick(self) -> tuple[str, int]:
        """Pick it up; why it failed (empty: it is held), and after how many tries."""
        why = ""
        for number in range(1, TRIES + 1):
            self.do(DriveTo(self.place))
            seen = self.see()
            if seen is None:
                return why or "not seen", number
            result = self.do(Pick(seen))
            if not isinstance(result, Failed):
                held = self.world.robot.holding and not self.world.resting_place(self.thing)
                return ("" if held else "held by belief only"), number
            why = result.reason
        return why, TRIES

    def put_down(self) -> str:
        """Put it down; why it failed (empty: it stands there)."""
        result = self.do(PutDown(self.place))
        if isinstance(result, Failed):
            return result.reason
        rests = self.world.resting_place(self.thing)
        return "" if rests == self.place else f"it is on {rests}"


def handle(trial: Row) -> Row:
    """Pick up and put down once."""
    handler = Handler(trial["thing"], trial["place"], trial["seed"])
    try:
        held, tries = handler.pick()
        return {"held": held, "tries": tries, "placed": held or handler.put_down()}
    finally:
        handler.world.close()


def trials(seeds: int) -> Iterator[Row]:
    """All trials in a shuffled order, so that a part of them is a fair sample."""
    every = [
        {"thing": thing, "place": piece.name, "seed": seed}
        for thing in HOME.objects
        for piece in HOME.furniture
        if _fits(thing, piece.name)
        for seed in range(1, seeds + 1)
    ]
    np.random.default_rng(ORDER_SEED).shuffle(every)
    yield from every


def _fits(thing: str, place: str) -> bool:
    try:
        with_placement(HOME, {thing: place})
    except InputError:
        return False
    return True


def _share(count: int, total: int) -> str:
    """So many of all, with the 95 % confidence interval (Wilson's)."""
    low, high = binomtest(count, total).proportion_ci(method="wilson")
    return f"{count} of {total} ({count / total:.1%}; 95 % interval {low:.1%} to {high:.1%})"


def main() -> None:
    """Print what was held and placed, and the failures by cause."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--seeds", type=int, default=5)
    arguments.add_argument("--journal", type=Path, default=Path("bench_handling.jsonl"))
    arguments.add_argument("--minutes", type=float, help="stop after so long")
    arguments.add_argument("--workers", type=int, default=1)
    options = arguments.parse_args()
    every = list(trials(options.seeds))
    limit_s = None if options.minutes is None else options.minutes * 60
    rows = measure(every, handle, options.journal, limit_s, options.workers)
    held = [row for row in rows if not row["held"]]
    placed = [row for row in held if not row["placed"]]
    first = sum(row["tries"] == 1 for row in held)
    print(f"{len(rows)} of {len(every)} trials")
    print(f"held {_share(len(held), len(rows))}, at the first try {first}")
    print(f"placed {_share(len(placed), len(held))} of those held")
    for what in ("held", "placed"):
        failed = [row for row in (rows if what == "held" else held) if row[what]]
        for cause, count in Counter(row[what] for row in failed).most_common():
            where = [f"{r['thing']} on {r['place']} ({r['seed']})" for r in failed]
            where = [w for w, row in zip(where, failed, strict=True) if row[what] == cause]
            print(f"  not {what}: {count} x {cause}: {', '.join(where)}")


if __name__ == "__main__":
    main()
