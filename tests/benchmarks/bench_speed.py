"""How much faster than real time the robot drives: `python tests/benchmarks/bench_speed.py`.

The same drives with and without logs, at several camera rates; for each what a second of mission
costs, part by part. Rendering, physics and the laser run on the ticking thread; the logs are
written by a thread of their own. On a busy machine processor time tells more than wall time.
"""

import tempfile
import time
from datetime import UTC, datetime
from pathlib import Path

from stopwatch import Stopwatch

import sim.bullet.camera
from executive.app.run_folder import new_folder
from executive.app.session import Session
from executive.config import load_settings
from executive.types.goals import DriveTo
from sim.body.laser import Laser

TOUR = ("desk", "counter_wagon", "sideboard", "delivery")
SETUPS = ((False, 0.0), (True, 0.0), (True, 1.0), (True, 5.0))
"""Logs or not, and camera rate (pictures a second)."""


def tour(logged: bool, camera_hz: float, runs: Path) -> str:
    """Drive from place to place; a line of the table."""
    settings = load_settings(user="oracle", llm="none", runs=runs, camera_hz=camera_hz)
    session, watch = Session(settings, recorded=logged), Stopwatch()
    render, scan = sim.bullet.camera.render, Laser.scan
    watch.around(sim.bullet.camera, "render", "rendering")
    watch.around(Laser, "scan", "laser")
    watch.around(session.world._client, "stepSimulation", "physics")
    watch.around(session.recorder, "record", "handing to the logs")
    started = datetime.now(UTC)
    logs = session._logs(new_folder(runs, started, "tour"), started) if logged else []
    session.recorder.open(logs, started)
    session.world.describe()
    wall, cpu = time.perf_counter(), time.process_time()
    for place in TOUR:
        session.parts.robot.start(DriveTo(place))
        session.parts.clock.wait(session.parts.clock.now() + 120.0)
        session.inbox.take_all()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    session.recorder.close()
    session.close()
    sim.bullet.camera.render, Laser.scan = render, scan  # type: ignore[method-assign]
    mission = session.parts.clock.now()
    parts = ", ".join(f"{part} {1e3 * s / mission:.1f}" for part, s in watch.seconds.items())
    name = f"{'logs' if logged else 'no logs'}, {camera_hz:g} pictures/s"
    return (
        f"{name:24} {mission:5.1f} s: {mission / wall:5.1f}x wall, {mission / cpu:5.1f}x processor;"
        f" ms a second: {parts}"
    )


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        for logged, camera_hz in SETUPS:
            print(tour(logged, camera_hz, Path(folder)))


if __name__ == "__main__":
    main()
