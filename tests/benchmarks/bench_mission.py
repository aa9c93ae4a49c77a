"""Where the time of one mission goes: run by hand, `python tests/benchmarks/bench_mission.py`.

Prints the wall time of the whole warm command (a fresh process), and, from a mission in this one,
its parts: start-up, thinking, physics, rendering, logging on the ticking thread, and the rest.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from stopwatch import Stopwatch

STARTED = time.perf_counter()


def whole_command(words: str, runs: Path) -> float:
    """Seconds of the command in a process of its own."""
    began = time.perf_counter()
    command = [sys.executable, "-m", "executive", "--user", "oracle", "--runs", str(runs), words]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - began


def parts(words: str, runs: Path) -> tuple[dict[str, float], float]:
    """Seconds of each part of a mission in this process, and its mission time."""
    import sim.bullet.camera
    from executive.app.session import Session
    from executive.config import load_settings
    from executive.perception.detector import OnnxDetector

    watch = Stopwatch()
    watch.around(sim.bullet.camera, "render", "rendering")
    watch.around(OnnxDetector, "detect", "recognition")
    session = Session(load_settings(user="oracle", runs=runs))
    watch.around(session.embodiment.truth._client, "stepSimulation", "physics")
    watch.around(session.recorder, "record", "logging, ticking thread")
    watch.seconds["start-up"] = time.perf_counter() - STARTED
    outcome = session.run(words)
    session.close()
    watch.seconds["thinking"] = outcome.thinking_time_s
    watch.seconds["rest (control, ticks, open and close logs)"] = outcome.wall_time_s - sum(
        seconds for part, seconds in watch.seconds.items() if part != "start-up"
    )
    return watch.seconds, outcome.mission_time_s - outcome.thinking_time_s


def main() -> None:
    """Print the table."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("words", nargs="?", default="Bring a sugar_box")
    words = arguments.parse_args().words
    with tempfile.TemporaryDirectory() as folder:
        seconds, moved = parts(words, Path(folder))
        print(f"'{words}': {moved:.1f} s of mission beside thinking")
        for part, value in sorted(seconds.items(), key=lambda item: -item[1]):
            print(f"  {value:6.2f} s  {part}")
        running = sum(seconds.values()) - seconds["start-up"] - seconds["thinking"]
        print(f"  mission time / wall time while acting: {moved / running:.1f}")
        print(f"  mission time / physics alone:          {moved / seconds['physics']:.1f}")
        walls = [whole_command(words, Path(folder)) for _ in range(3)]
        print("whole command, warm: " + ", ".join(f"{wall:.1f}" for wall in walls) + " s")


if __name__ == "__main__":
    main()
