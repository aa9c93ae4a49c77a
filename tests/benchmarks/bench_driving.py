"""Random drives in physics: `python tests/benchmarks/bench_driving.py`; Ctrl-C stops it.

From a random free spot of a home to another. Counts contacts of the robot with anything but the
floor (every control period), and compares the way driven with the shortest on the grid. The same
command goes on where it was stopped.
"""

import argparse
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from progress import Row, measure
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from executive.events import Inbox
from executive.records import Record
from sim.body.base import FREE
from sim.body.skill import Skill
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.navigation.grid import OccupancyGrid, Unreachable, reachable
from sim.objects.objects import load_objects
from sim.tools.generation import generate_home
from sim.world import PhysicsWorld

HOMES = ("four_rooms", "generated")
GENERATED = {"rooms": 12, "furniture": 60, "seed": 3}
LONGEST = 1.15


class NoRecorder:
    """Keeps nothing."""

    def record(self, record: Record) -> None:
        """Drop the record."""


@cache
def home(name: str) -> Home:
    """The home; the generated one is that of `python -m sim generate --rooms 12 --furniture 60`."""
    if name != "generated":
        return load_home(name)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "generated.toml"
        file.write_text(generate_home(**GENERATED))
        return load_home(str(file))


@cache
def grid(name: str) -> OccupancyGrid:
    """Its map."""
    return OccupancyGrid.from_home(home(name))


def shortest_m(name: str, start: tuple[float, float], goal: tuple[float, float]) -> float:
    """The shortest way on the grid's free cells and 8 neighbours, comfort or not (metres)."""
    shape = grid(name).clearance.shape
    ends = [int(np.ravel_multi_index(grid(name).cell(end), shape)) for end in (start, goal)]
    lengths = dijkstra(_lengths(name), directed=False, indices=ends[0])
    return float(lengths[ends[1]])


@cache
def _lengths(name: str) -> csr_array:
    graph = grid(name).graph.tocoo()
    columns, rows = np.unravel_index(graph.row, grid(name).clearance.shape)
    others, below = np.unravel_index(graph.col, grid(name).clearance.shape)
    steps = np.hypot(columns - others, rows - below) * grid(name).resolution
    return csr_array((steps, (graph.row, graph.col)), shape=graph.shape)


@cache
def world(name: str) -> PhysicsWorld:
    """One world a home, driven in from pair to pair."""
    return PhysicsWorld(home(name), load_objects(), Inbox(), NoRecorder(), camera_hz=0.0)


def pairs(name: str, count: int) -> list[Row]:
    """Random free spots that can be reached from one another, at least 1 m apart."""
    chance = np.random.default_rng(7)
    there = np.argwhere(reachable(grid(name), home(name).robot_start[:2]) & grid(name).free)
    found: list[Row] = []
    while len(found) < count:
        start, goal = (
            tuple(map(float, grid(name).point(tuple(chance.choice(there))))) for _ in range(2)
        )
        if np.hypot(start[0] - goal[0], start[1] - goal[1]) > 1.0:
            yaw = float(chance.uniform(-np.pi, np.pi))
            found.append({"home": name, "start": start, "goal": goal, "yaw": yaw})
    return found


def drive(trial: Row) -> Row:
    """Put the robot at the start, and drive it to the goal."""
    place, robot = world(trial["home"]), world(trial["home"]).robot
    client, hardware = place._client, place._hardware
    for joint, value in zip(hardware._base, (*trial["start"], trial["yaw"]), strict=True):
        client.resetJointState(hardware.body, joint, value)
    hardware.park()
    spots, touched = [], set()
    skill: Skill = robot._navigator.go((*trial["goal"], trial["yaw"]), FREE)
    floors = {b for b, name in place._fixtures.items() if name.startswith("floor")}
    failure, periods = "", 0
    try:
        for _ in skill:
            place._pass_period()
            periods += 1
            spots.append(hardware.base_pose[:2])
            contacts = client.getContactPoints(bodyA=hardware.body)
            touched |= {c[2] for c in contacts} - floors - {hardware.body}
    except Unreachable as reason:
        failure = reason.clause("goal")
    driven = float(np.linalg.norm(np.diff(spots, axis=0), axis=1).sum()) if spots else 0.0
    return {
        "failure": failure,
        "touched": sorted(place._fixtures.get(b, place._things.get(b, "?")) for b in touched),
        "driven_m": round(driven, 3),
        "shortest_m": round(shortest_m(trial["home"], trial["start"], trial["goal"]), 3),
        "seconds": round(periods / 60, 2),
    }


def main() -> None:
    """Print the table."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--pairs", type=int, default=200)
    arguments.add_argument("--journal", type=Path, default=Path("bench_driving.jsonl"))
    options = arguments.parse_args()
    for name in HOMES:
        rows = measure(pairs(name, options.pairs), drive, options.journal)
        done = [row for row in rows if not row["failure"]]
        ratios = np.array([row["driven_m"] / row["shortest_m"] for row in done])
        touched = sum(bool(row["touched"]) for row in rows)
        print(f"{name}: {len(done)} of {len(rows)} drives arrived, {touched} touched something")
        print(
            f"  way driven / shortest on the grid: mean {ratios.mean():.3f}, 95 % below "
            f"{np.quantile(ratios, 0.95):.3f}, most {ratios.max():.3f}; "
            f"{sum(ratios > LONGEST)} above {LONGEST}"
        )
        for row in rows:
            if row["failure"] or row["touched"]:
                print(f"  {row['start']} to {row['goal']}: {row['failure']} {row['touched']}")


if __name__ == "__main__":
    main()
