"""From a stop until the robot is at rest: `python tests/benchmarks/bench_stop.py`. Ctrl-C ends it.

Missions in PyBullet, as the command runs them, with logs and a picture a second. Somebody says stop
at a random moment, drawn from a seed: some time after the robot began to drive, look, handle
something, think with the embedded model or ask a question that nobody answers; or at any moment.
Told is how long it takes until the robot has come to rest and the mission has ended, and what the
robot was doing. In wall time other programs on the machine have their part; of processor time what
the thread that ticks has used meanwhile is told, and how late it heard the stop.
The same command with the same `--journal` goes on.
"""

import argparse
import atexit
import gc
import io
import random
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from unittest import mock

import numpy as np
from progress import Row, measure

from executive import Session, load_settings
from executive.events import Inbox, StopRequested
from executive.records import Activity, EventTaken, Record, Tick, TreeShape
from executive.shell import all_is_kept
from executive.types.dialogue import Question
from executive.types.outcome import MissionStatus
from logs.recorder import FanOut
from logs.viewer import sink as _imported_by_the_command  # noqa: F401
from sim.pictures import beside

atexit.register(gc.unfreeze)  # what `all_is_kept` keeps: libraries tell of it at the end

ANY = "anything"
KINDS = (
    ANY,
    Activity.DRIVING,
    Activity.LOOKING,
    Activity.HANDLING,
    Activity.THINKING,
    Activity.ASKING,
)
ORDERS = ("Bring a sugar_box", "Bring a mustard_bottle", "Bring a peach")
LATEST_S = {
    ANY: 12.0,
    Activity.DRIVING: 1.0,
    Activity.LOOKING: 0.3,
    Activity.HANDLING: 2.5,
    Activity.THINKING: 1.0,
    Activity.ASKING: 1.0,
}
"""A stop comes at most so long after what it waits for has begun (seconds of wall time)."""
MOST = {Activity.DRIVING: 3, Activity.LOOKING: 3, Activity.HANDLING: 2}
"""It is waited for until it begins for the first time, or for a later one, at most so many."""


class Silent:
    """A person who is there, and answers nothing."""

    def __init__(self, inbox: Inbox) -> None:
        """Be asked."""
        self._inbox = inbox

    def ask(self, question: Question) -> int:
        """Take all the time."""
        return self._inbox.open(real=True)

    def cancel(self, request: int) -> None:
        """Be asked no more."""
        self._inbox.drop(request)

    def tell(self, text: str) -> None:
        """Listen."""


@dataclass
class Stopper:
    """Looks at what a mission records, and says stop when its moment has come."""

    inbox: Inbox
    kind: str
    which: int
    after_s: float
    doing: str = ""
    told: tuple[float, float] | None = None
    heard: tuple[float, float] | None = None
    rested: tuple[float, float] | None = None
    _activities: dict[str, str] = field(default_factory=dict)
    _timer: threading.Timer | None = None
    _clock: int = field(default_factory=lambda: time.pthread_getcpuclockid(threading.get_ident()))

    def look(self, record: Record) -> None:
        """Take note of a record."""
        match record:
            case TreeShape(nodes):
                self._activities = {node.path: node.activity for node in nodes if node.activity}
                self._begins(ANY)
            case Tick(nodes=nodes):
                running = [n.path for n in nodes if n.status == "RUNNING"]
                some = [self._activities[path] for path in running if path in self._activities]
                self._begins(some[-1] if some else "")
            case EventTaken(StopRequested()):
                self.heard = self._now()

    def rests(self) -> None:
        """The mission has ended."""
        self.rested = self._now()
        if self._timer:
            self._timer.cancel()

    def _begins(self, activity: str) -> None:
        new = activity != self.doing
        self.doing = activity
        if new and activity == self.kind:
            self.which -= 1
            if self.which <= 0 and self._timer is None:
                self._timer = threading.Timer(self.after_s, self._stop)
                self._timer.start()

    def _stop(self) -> None:
        self.told = self._now()
        self.inbox.post(StopRequested("Ctrl-C"))

    def _now(self) -> tuple[float, float]:
        """Wall time, and the processor time of the thread that ticks (s)."""
        return time.perf_counter(), time.clock_gettime(self._clock)


def stop_once(trial: Row) -> Row:
    """Run a mission, and stop it."""
    chance = random.Random(trial["seed"])
    kind = KINDS[trial["seed"] % len(KINDS)]
    order = chance.choice(ORDERS)
    which = chance.randint(1, MOST.get(kind, 1))
    after_s = chance.uniform(0.0, LATEST_S[kind])
    inbox = Inbox()
    thinks = kind == Activity.THINKING or (kind == ANY and chance.random() < 0.5)
    asks = kind == Activity.ASKING
    with tempfile.TemporaryDirectory() as folder:
        settings = load_settings(
            llm="embedded" if thinks else "none",
            user="oracle",
            search="paper" if thinks or asks else "plan",
            seed=trial["seed"],
            runs=folder,
        )
        silent = Silent(inbox) if asks else None
        as_the_command = mock.patch.object(beside, "worthwhile", return_value=True)
        with all_is_kept(), as_the_command:  # which is no worker and draws pictures beside
            opened = Session(settings, inbox=inbox, user=silent, out=io.StringIO())
        with opened as session:
            stopper = Stopper(inbox, kind, which, after_s)
            return {"order": order, "kind": kind, **_stopped(session, order, stopper)}


def _stopped(session: Session, order: str, stopper: Stopper) -> Row:
    record, leave = FanOut.record, Session._leave
    doing: list[str] = []

    def looked(self: FanOut, given: Record) -> None:
        stopper.look(given)
        record(self, given)
        if stopper.heard and not doing:
            doing.append(stopper.doing)

    def left(self: Session) -> None:
        stopper.rests()
        leave(self)

    with mock.patch.object(FanOut, "record", looked), mock.patch.object(Session, "_leave", left):
        outcome = session.run(order)
    told, heard, rested = stopper.told, stopper.heard, stopper.rested
    if told is None or heard is None or rested is None:
        return {"doing": None}
    moving = session.parts.robot.moving() if outcome.status == MissionStatus.STOPPED else ()  # type: ignore[attr-defined]
    return {
        "doing": doing[0] or "between",
        "rest_s": rested[0] - told[0],
        "heard_s": heard[0] - told[0],
        "rest_processor_s": rested[1] - told[1],
        "heard_processor_s": heard[1] - told[1],
        "moving": list(moving),
    }


def table(rows: Iterable[Row]) -> Iterator[str]:
    """What is told."""
    rows = list(rows)
    stopped = [row for row in rows if row["doing"] is not None]
    yield f"{len(stopped)} of {len(rows)} missions were stopped; the others had ended before"
    still = sum(not row["moving"] for row in stopped)
    yield f"{still} robots stood still"
    yield ""
    yield "| stopped while | of | to rest, wall: median, 95 %, worst | processor | heard, worst |"
    yield "|---|---|---|---|---|"
    doings = sorted({row["doing"] for row in stopped})
    for doing in (*doings, "all"):
        some = [row for row in stopped if doing in (row["doing"], "all")]
        told = (_spread(some, "rest_s"), _spread(some, "rest_processor_s"))
        heard = f"{max(r['heard_s'] for r in some):.2f}, "
        heard += f"{max(r['heard_processor_s'] for r in some):.2f} s"
        yield f"| {doing} | {len(some)} | {' | '.join(told)} | {heard} |"
    yield ""
    for row in sorted(stopped, key=lambda row: -row["rest_processor_s"])[:5]:
        yield (
            f"seed {row['seed']}: {row['order']}, {row['doing']}: {row['rest_s']:.2f} s, "
            f"processor {row['rest_processor_s']:.2f} s"
        )


def _spread(rows: list[Row], of: str) -> str:
    times = np.array([row[of] for row in rows])
    return f"{np.median(times):.2f}, {np.quantile(times, 0.95):.2f}, {times.max():.2f} s"


def main() -> None:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--stops", type=int, default=200, metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="of the first one")
    parser.add_argument("--workers", type=int, default=1, metavar="N")
    parser.add_argument("--journal", type=Path, metavar="FILE", help="to go on where it was")
    given = parser.parse_args()
    trials = [{"seed": seed} for seed in range(given.seed, given.seed + given.stops)]
    with tempfile.TemporaryDirectory() as folder:
        journal = given.journal or Path(folder) / "journal.jsonl"
        for line in table(measure(trials, stop_once, journal, workers=given.workers)):
            print(line)


if __name__ == "__main__":
    main()
