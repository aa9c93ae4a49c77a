"""The program, told to stop at a random moment: how long until it rests, and until it has ended."""

import random
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from executive.replay.replaying import replay
from logs.recording.reader import Run

LATEST_S = 8.0
"""A stop comes at most so long after the start of the program (seconds of wall time)."""
LONGEST_S = 60.0
WAYS = (
    signal.SIGINT,
    signal.SIGTERM,
    signal.SIGHUP,
    "Stop!",
    "please stop",
    "STOP IT NOW",
    "cancel",
)


@dataclass
class Stopped:
    """How it went; seconds of wall time from the stop on, None if there was no mission yet."""

    rest_s: float | None = None
    exit_s: float = 0.0
    violations: list[str] = field(default_factory=list)


def stop_once(seed: int) -> Stopped:
    """Start a mission in PyBullet, stop it, and look at what it leaves."""
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # where it is ignored, the program ignores it, too
    chance = random.Random(seed)
    way, stopped = chance.choice(WAYS), Stopped()
    words = chance.choice(("Bring a sugar_box", "Take the mug", "Find the hammer"))
    model = chance.choice(("none", "none", "embedded"))
    with TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "executive", "--seed", str(seed), "--runs", folder]
        user = "console" if isinstance(way, str) else "oracle"
        program = subprocess.Popen(
            [*command, "--llm", model, "--user", user, words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        time.sleep(chance.uniform(0.05, LATEST_S))
        told_ns = time.time_ns()
        printed = _tell(program, way)
        stopped.exit_s = (time.time_ns() - told_ns) / 1e9
        _judge(stopped, Path(folder), told_ns, program.returncode, printed)
    stopped.violations = [f"seed {seed}, {way}: {line}" for line in stopped.violations]
    return stopped


def _tell(program: "subprocess.Popen[str]", way: signal.Signals | str) -> str:
    """Say stop; what the program has printed when it has ended."""
    try:
        if isinstance(way, str):
            return program.communicate(f"{way}\n", timeout=LONGEST_S)[0]
        program.send_signal(way)
        return program.communicate(timeout=LONGEST_S)[0]
    except subprocess.TimeoutExpired:
        program.kill()
        return program.communicate()[0] + "\nit does not end"


def _judge(stopped: Stopped, runs: Path, told_ns: int, code: int, printed: str) -> None:
    """Note what is wrong, and when the robot was at rest."""
    wrong = stopped.violations
    if "Traceback" in printed or "does not end" in printed:
        wrong.append(printed[-400:])
    folders = list(runs.iterdir())
    if code != 130 and not (folders and code in (0, 1)):
        wrong.append(f"exit status {code}: {printed[-400:]}")
    for folder in folders:
        outcome = Run(folder).outcome()
        if outcome is None or (code == 130) != (outcome.status == "stopped"):
            wrong.append(f"exit status {code}, but {outcome}")
        if replay(folder).parting is not None:
            wrong.append("the replay is not the same")
        if code == 130 and (rest_ns := _rested_ns(folder)):
            stopped.rest_s = (rest_ns - told_ns) / 1e9


def _rested_ns(folder: Path) -> int | None:
    """When (wall time, ns) the last event of a recording was taken: the robot had come to rest."""
    with (folder / "mission.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        events = [message for _, _, _, message in reader.iter_decoded_messages(["/event"])]
    return int(events[-1].wall_time.ToNanoseconds()) if events else None
