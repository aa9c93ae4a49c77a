"""Missions over a wire that fails, by seed: what each claims is held against the world's truth."""

import io
import random
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from odd_wire import Mischief, OddWire
from served import served

from executive.app.session import Session
from executive.campaign.truth import completed, whereabouts
from executive.config import load_settings
from executive.events import StopRequested
from executive.ros.profile import profile_text
from executive.types import HAND, CommandKind, MissionStatus, Outcome
from sim.served.simulation import Simulation

COMMANDS = ("Bring a power_drill", "Take a banana from the desk", "Find a power_drill", "Go home")
MISSIONS = 5
"""So many with one session, one after the other."""
HANGS_S = 120.0
STOPPED_S, RECONNECTED_S = 0.5, 2.0
"""At rest so long after a stop, and after there is a link again (real time)."""
SILENT_S = 1.5
"""So long one waits for what may never come."""
NOISE_S = 30.0
"""What a busy machine may add to either."""


@dataclass
class Fault:
    """What should not have been."""

    seed: int
    words: str
    what: str


def missions(seed: int, folder: Path) -> Iterator[Fault]:
    """Some missions over a bad wire; yields what is wrong with them."""
    chance = random.Random(seed)
    profile = folder / "impatient.toml"
    text = profile_text("served_instant")[0].decode()
    for section in ("drive", "look", "pick", "place"):
        text = text.replace(f"[{section}]", f"[{section}]\nsilent_s = {SILENT_S}")
    profile.write_text(text.replace("[camera]", f"[camera]\nlate_s = {SILENT_S}"))
    with served(speed=200.0) as there, OddWire(there.server.address, seed) as wire:
        settings = load_settings(
            robot=wire.url, profile=str(profile), llm="none", user="none", runs=folder
        )
        with Session(settings, recorded=False, out=io.StringIO()) as session:
            for _ in range(MISSIONS):
                wire.mischief = _mischief(chance)
                words = chance.choice(COMMANDS)
                said = _Mission(session, wire, there, words)
                said.run(chance.uniform(0.1, 2.0) if chance.random() < 0.4 else None)
                yield from (Fault(seed, words, what) for what in said.wrong)
                wire.mischief = Mischief()
                time.sleep(0.1)


def _mischief(chance: random.Random) -> Mischief:
    often = {
        "delay": chance.choice((0.0, 0.1, 0.5)),
        "cut": chance.choice((0.0, 0.0, 0.002, 0.01)),
        "halve": chance.choice((0.0, 0.01, 0.05)),
        "swap": chance.choice((0.0, 0.05, 0.2)),
    }
    return Mischief(**often, delay_s=chance.choice((0.001, 0.01, 0.05)))


@dataclass
class _Mission:
    session: Session
    wire: OddWire
    there: Simulation
    words: str

    def __post_init__(self) -> None:
        self.wrong: list[str] = []

    def run(self, stop_after_s: float | None) -> None:
        """Run it, and stop it then; whatever comes of it, the robot rests in the end."""
        began = time.monotonic()
        timer = threading.Timer(stop_after_s or HANGS_S, self._stop)
        timer.start()
        outcome = self.session.run(self.words)
        timer.cancel()
        if time.monotonic() - began > HANGS_S:
            self.wrong.append("it hangs")
        self._judge(outcome)

    def _stop(self) -> None:
        self.session.inbox.post(StopRequested("Ctrl-C"))

    def _judge(self, outcome: Outcome) -> None:
        body = self.there.body
        if outcome.status == MissionStatus.DONE and outcome.object is not None:
            truth = whereabouts(outcome.object, body.world)
            if not completed(outcome, lambda _: truth) and not _says_so(outcome, truth):
                self.wrong.append(f"it says {outcome.reason!r}, and the thing is at {truth!r}")
        self.wire.mischief = Mischief()
        latest = time.monotonic() + RECONNECTED_S + NOISE_S
        while body.busy and time.monotonic() < latest:
            time.sleep(0.01)
        if body.busy:
            self.wrong.append(f"it ended {outcome.status} ({outcome.reason}) and goes on")
        if self.session.inbox.awaits_anything:
            self.wrong.append("a request has no end")


def _says_so(outcome: Outcome, truth: str) -> bool:
    """Whether it says that it was not as asked for, and how it is."""
    name = str(outcome.object).replace("_", " ")
    return (
        outcome.kind == CommandKind.FIND
        and truth == HAND
        and outcome.reason == f"I hold the {name}."
    )
