"""Missions over a wire that fails, by seed: what each claims is held against the world's truth."""

import random
import re
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from odd_wire import Mischief, OddWire
from resting import Watch
from served import served
from soaking.claims import NOT_FOUND, Names, Witness

from executive.app.session import Session
from executive.campaign.truth import completed, whereabouts
from executive.config import load_settings
from executive.events import Inbox, StopRequested
from executive.language.wording import Wording
from executive.ros.profile import profile_text
from executive.testing.bench import four_rooms
from executive.types.commands import CommandKind
from executive.types.home import HAND
from executive.types.outcome import MissionStatus, Outcome
from executive.user import Nobody
from sim.served.simulation import Simulation

COMMANDS = (
    "Bring a power_drill",
    "Take a banana from the desk",
    "Find a power_drill",
    "Go to the desk",
)
MISSIONS = 5
"""So many with one session, one after the other."""
FAST, SLOW = 200.0, 5.0
"""How fast a robot's time passes. A slow one is stopped as it moves; a fast one gets to ends."""
HANGS_S = 120.0
STOPPED_S, RECONNECTED_S = 0.5, 2.0
"""At rest so long after a stop, and after there is a link again (`Watch` has the time)."""
RESTLESS_S = 10.0
"""So long it is waited for what comes too late."""
SILENT_S = 1.5
"""So long one waits for what may never come."""


@dataclass
class Household:
    """What came of some missions with one session.

    Attributes:
        faults: what should not have been, a line each.
        stops: of those that moved when they were told to stop, from that to rest (s).
        reconnections: if the link was lost meanwhile, from having one again to rest (s).
    """

    faults: list[str] = field(default_factory=list)
    stops: list[float] = field(default_factory=list)
    reconnections: list[float] = field(default_factory=list)


class _Listener(Nobody):
    """Hears what the robot says, and has each sentence judged."""

    witness: Witness

    def tell(self, text: str) -> None:
        self.witness.heard(text)


def missions(seed: int, folder: Path) -> Household:
    """Some missions over a bad wire."""
    chance, came = random.Random(seed), Household()
    speed = chance.choice((FAST, SLOW))
    inbox = Inbox()
    listener = _Listener(inbox)
    with served(speed=speed) as there, OddWire(there.server.address, seed) as wire:
        settings = load_settings(
            robot=wire.url, profile=_impatient(folder), llm="none", user="none", runs=folder
        )
        with (
            Session(settings, recorded=False, inbox=inbox, user=listener) as session,
            Watch(there, wire) as watch,
        ):
            listener.witness = _witness(session, there)
            for _ in range(MISSIONS):
                wire.mischief = _mischief(chance)
                words, stopped = chance.choice(COMMANDS), speed == SLOW or chance.random() < 0.4
                mission = _Mission(session, wire, there, watch, listener.witness, came)
                mission.run(words, chance.uniform(0.1, 2.0) if stopped else None)
                came.faults += [f"{seed}: {words}: {what}" for what in mission.wrong]
                wire.mischief = Mischief()
                time.sleep(0.1)
    return came


def _impatient(folder: Path) -> str:
    """A profile of a robot of which one soon says that it does not answer."""
    profile = folder / "impatient.toml"
    text = profile_text("served_instant")[0].decode()
    for section in ("drive", "look", "pick", "place"):
        text = text.replace(f"[{section}]", f"[{section}]\nsilent_s = {SILENT_S}")
    profile.write_text(text.replace("[camera]", f"[camera]\nlate_s = {SILENT_S}"))
    return str(profile)


def _witness(session: Session, there: Simulation) -> Witness:
    home = four_rooms()
    say = Wording(session.parts.knowledge.called)
    names = Names(say, tuple(home.objects), [place.name for place in home.places()])
    return Witness(there.body.world, home.objects, names)


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
    watch: Watch
    witness: Witness
    came: Household
    wrong: list[str] = field(default_factory=list)

    def run(self, words: str, stop_after_s: float | None) -> None:
        """Run it, and stop it then; whatever comes of it, the robot rests in the end."""
        self._told: float | None = None
        self.witness.begin()
        began = time.monotonic()
        timer = threading.Timer(stop_after_s or HANGS_S, self._stop)
        timer.start()
        outcome = self.session.run(words)
        timer.cancel()
        if time.monotonic() - began > HANGS_S:
            self.wrong.append("it hangs")
        self._judge_words(outcome)
        self._judge_rest(outcome)
        if self.session.inbox.awaits_anything:
            self.wrong.append("a request has no end")

    def _stop(self) -> None:
        self._told = self.watch.now
        self.session.inbox.post(StopRequested("Ctrl-C"))

    def _judge_words(self, outcome: Outcome) -> None:
        world = self.there.body.world
        self.wrong += self.witness.wrong
        self.wrong += _overlooked(self.witness, outcome)
        if outcome.status == MissionStatus.DONE and outcome.object is not None:
            truth = whereabouts(outcome.object, world)
            if not completed(outcome, lambda _: truth) and not _says_so(outcome, truth):
                self.wrong.append(f"it says {outcome.reason!r}, and the thing is at {truth!r}")

    def _judge_rest(self, outcome: Outcome) -> None:
        watch = self.watch
        told = watch.now if self._told is None else self._told
        self.wire.mischief = Mischief()
        if not watch.wait_for_rest(RESTLESS_S):
            self.wrong.append(f"it ended {outcome.status} ({outcome.reason}) and goes on")
        late, since = watch.moved - told, watch.moved - watch.whole_since
        if late > 0.0 and watch.whole_since > told:
            self.came.reconnections.append(max(0.0, since))
        elif late > 0.0:
            self.came.stops.append(late)
        if late > STOPPED_S and since > RECONNECTED_S:
            self.wrong.append(
                f"it ended {outcome.status} ({outcome.reason}), and moved {late:.2f} s after that "
                f"or the stop, with a link for {since:.2f} s"
            )


def _overlooked(witness: Witness, outcome: Outcome) -> Iterator[str]:
    """What the robot says that it did not find where it was all the time."""
    for text in map(witness.in_names, (*witness.said, outcome.reason)):
        for match in NOT_FOUND.finditer(text):
            thing = match[0].split()[5]
            for place in re.findall(r"(?:at|the) (\w+)", match["places"]):
                if witness.was_at[thing] == {place}:
                    yield f"said {match[0]!r}, and there it was"


def _says_so(outcome: Outcome, truth: str) -> bool:
    """Whether it says that it was not as asked for, and how it is."""
    name = str(outcome.object).replace("_", " ")
    return (
        outcome.kind == CommandKind.FIND
        and truth == HAND
        and outcome.reason == f"I hold the {name}."
    )
