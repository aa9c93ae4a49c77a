"""How much faster than real time physics runs: `python tests/benchmarks/bench_physics.py`.

Prints mission time per wall time of each goal of one fetch-and-carry, without pictures for the log.
"""

import time

from executive.clock import SimulatedClock
from executive.events import Inbox
from executive.perception.pipeline import locate
from executive.records import Record
from executive.types.goals import DriveTo, Goal, LookAt, Pick, PutDown
from sim.home.home_file import load_home
from sim.objects.objects import load_objects
from sim.world import PhysicsWorld

THING = "sugar_box"


class NoRecorder:
    """Keeps nothing."""

    def record(self, record: Record) -> None:
        """Drop the record."""


def main() -> None:
    """Print the table."""
    began = time.perf_counter()
    home, inbox = load_home("four_rooms"), Inbox()
    world = PhysicsWorld(home, load_objects(), inbox, NoRecorder(), camera_hz=0.0)
    clock = SimulatedClock(inbox, world)
    print(f"building the world: {time.perf_counter() - began:.2f} s")

    def do(goal: Goal) -> None:
        mission, wall = clock.now(), time.perf_counter()
        world.robot.start(goal)
        clock.wait(mission + 120.0)
        (event,) = inbox.take_all()
        mission, wall = clock.now() - mission, time.perf_counter() - wall
        name = type(goal).__name__
        print(f"{name:8} {mission:5.1f} s in {wall:5.2f} s: {mission / wall:5.1f}x  {event}")

    place = home.placement[THING]
    do(DriveTo("desk"))
    do(DriveTo(place))
    do(LookAt(place))
    frame = world.camera.capture()
    (seen,) = (d for d in world.detector.detect(frame) if d.label == THING)
    do(Pick(locate(seen, frame)))
    do(DriveTo("delivery"))
    do(PutDown("delivery"))
    world.close()


if __name__ == "__main__":
    main()
