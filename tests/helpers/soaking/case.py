"""One household: a few missions in a row, in which anything may go wrong."""

import contextlib
import io
import json
import random
import signal
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FrameType
from typing import Any

from mcap.reader import make_reader

from executive.app.parts import Parts
from executive.app.session import Session
from executive.config import KnowledgeSystem, Settings
from executive.errors import InputError
from executive.events import Inbox, StopRequested
from executive.interfaces.simulation import SimulatedHome
from executive.language.wording import Wording
from executive.replay.replaying import replay, replay_text
from executive.text import printable
from executive.types.commands import CommandKind
from executive.types.home import FLOOR
from executive.types.outcome import MissionStatus, Outcome
from logs.recording.reader import Run
from sim.faults.orders import parse_faults
from sim.home.floorplan import doors_between
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.home.validation import with_placement
from sim.tools.generation import generate_home
from soaking.chaos import Chaos, ChaosEyes, ChaosModel, ChaosRobot, ChaosSink
from soaking.claims import Names, Notes, Witness, false_searches, looked_at, ticked_after_stop
from soaking.people import Person, words

LONGEST_S = 60.0
"""Wall time after which a mission counts as one that does not end."""
MOST_ACTIONS = 400
"""No mission does more than this; each has a deadline, so that gives the longest mission."""
LEAVING_S = 3.0
"""How long threads may take to end after the session."""
MOST_MISSIONS = 4
INSTANT = ("moved", "blocked", "slip", "drop", "stuck", "blind", "noise", "miss")
"""Faults of the instant world that leave the truth to be told."""
SOMETHING = "something"
"""What the robot calls what it feels in its hand and does not know."""


class HungError(BaseException):
    """A mission does not end."""


@dataclass
class Household:
    """What a seed draws: the home, the settings, what goes wrong."""

    seed: int
    chance: random.Random = field(init=False)
    missions: int = field(init=False)

    def __post_init__(self) -> None:
        self.chance = random.Random(self.seed)
        self.missions = self.chance.randint(1, MOST_MISSIONS)


def missions_of(seed: int) -> int:
    """How many missions the household of a seed has."""
    return Household(seed).missions


def run_household(seed: int, at_most: int = MOST_MISSIONS) -> list[str]:
    """Run the missions of a seed's household in the instant world; a line each violation."""
    with TemporaryDirectory() as folder, watchdog():
        return [f"seed {seed}: {line}" for line in Soak(seed, at_most, Path(folder)).run()]


@cache
def _homes() -> tuple[str, ...]:
    """The packaged home, more often than not, and some generated ones."""
    folder = Path(_kept.name)
    files = []
    for seed, (rooms, furniture) in enumerate(((3, 8), (4, 12), (6, 24))):
        file = folder / f"home{seed}.toml"
        file.write_text(generate_home(rooms, furniture, seed))
        files.append(str(file))
    return ("four_rooms",) * 5 + tuple(files)


_kept = TemporaryDirectory()


class Soak:
    """The missions of one household, one after the other."""

    def __init__(self, seed: int, at_most: int, runs: Path) -> None:
        drawn = Household(seed)
        chance = self._chance = drawn.chance
        self._missions = min(drawn.missions, at_most)
        self._chaos = self._draw_chaos(chance)
        self._settings = self._draw_settings(chance, runs)
        self._home = load_home(self._settings.home)
        self._inbox = Inbox()

    def _draw_chaos(self, chance: random.Random) -> Chaos:
        return Chaos(
            chance,
            rate=chance.choice((0.0, 0.0, 0.02, 0.1, 0.3)),
            stops_at=[chance.randint(1, 60) for _ in range(chance.choice((0, 0, 0, 1, 2, 5)))],
        )

    def _draw_settings(self, chance: random.Random, runs: Path) -> Settings:
        home_name = chance.choice(_homes())
        home = load_home(home_name)
        placement = _placement(chance, home)
        return Settings(
            home=home_name,
            world="fake",
            runs=runs,
            user="none",
            seed=chance.randrange(1000),
            knowledge=chance.choice(list(KnowledgeSystem)),
            defaults=chance.random() < 0.5,
            elicit=chance.choice(("rank", "generate")),
            learn=chance.random() < 0.8,
            fault=tuple(faults(chance, with_placement(home, placement), INSTANT)),
            place=placement,
            action_timeout_s=chance.choice((1.0, 5.0, 120.0, 120.0)),
            answer_timeout_s=chance.choice((5.0, 120.0)),
            llm_timeout_s=chance.choice((5.0, 60.0)),
            search=chance.choice(("plan", "plan", "paper")),
            question_s=chance.choice((0.0, 20.0, 60.0, 1000.0)),
        )

    def run(self) -> Iterator[str]:
        threads = threading.active_count()
        self._build()
        try:
            for number in range(self._missions):
                yield from (f"mission {number}: {line}" for line in self._mission())
            yield from (f"afterwards: {line}" for line in self._all_is_well_again())
        finally:
            self._session.close()
        latest = time.monotonic() + LEAVING_S
        while (left := threading.active_count() - threads) > 1 and time.monotonic() < latest:
            time.sleep(0.05)
        if left > 1:
            yield f"{left} threads are left"

    def _build(self) -> None:
        chaos, inbox = self._chaos, self._inbox
        self._notes = Notes()
        health = self._chance.choice((0.0, 0.5, 0.9, 1.0))
        model = ChaosModel(chaos, inbox, health, self._chance.choice((60, 512, 4096)))
        self._model = model if self._settings.uses_llm else None
        rate, chaos.rate = chaos.rate, 0.0  # while the parts are built, all is well
        self._session = Session(
            self._settings,
            inbox=inbox,
            model=self._model,
            out=io.StringIO(),
            sinks=[self._notes, ChaosSink(chaos)],
            change=self._disturb,
        )
        chaos.rate = rate
        say = Wording(self._session.parts.knowledge.called)
        places = [place.name for place in self._home.places()]
        words = Names(say, tuple(self._home.objects), places)
        self._witness = Witness(self._world, self._home.objects, words)

    def _disturb(self, parts: Parts) -> Parts:
        """The parts, each of which may go wrong."""
        chaos, inbox = self._chaos, self._inbox
        places = [place.name for place in self._home.places()]
        self._person = Person(
            chaos,
            inbox,
            lambda name: self._world.resting_place(name),
            places,
            lambda text: self._witness.heard(text),
        )
        self._robot = ChaosRobot(parts.robot, chaos, inbox)
        self._faults = getattr(parts.perception._detector, "_injector", None)
        eyes = ChaosEyes(parts.perception, chaos, inbox)
        return replace(parts, user=self._person, robot=self._robot, perception=eyes)

    @property
    def _world(self) -> SimulatedHome:
        world = self._session.world
        assert world
        return world

    def _mission(self) -> Iterator[str]:
        said = words(self._chance, self._home)
        if self._chance.random() < 0.02:
            self._inbox.post(StopRequested("the person"))
        self._begin()
        try:
            outcome = self._session.run(said)
        except InputError as error:  # words that are none: refused in a sentence
            if str(error) != printable(error):
                yield f"{said!r} is refused with {str(error)!r}"
            return
        except (Exception, HungError) as error:
            yield f"{said!r} raised {error!r}"
            return
        yield from (f"{said!r}: {line}" for line in self._judge(outcome))

    def _begin(self) -> None:
        self._witness.begin()
        self._notes.records.clear()
        self._robot.goals.clear()
        self._robot.halts = 0
        self._chaos.struck.clear()
        if self._model:
            self._model.failed = self._model.unanswered = 0

    # --- what must hold ---

    def _judge(self, outcome: Outcome) -> Iterator[str]:
        yield from self._witness.wrong
        yield from self._of_the_outcome(outcome)
        yield from self._at_rest()
        yield from self._of_the_hand()
        if self._session.folder:
            yield from _whole(self._session.folder, outcome)

    def _of_the_outcome(self, outcome: Outcome) -> Iterator[str]:
        records, settings = self._notes.records, self._settings
        reason = outcome.reason
        if not reason.strip() or reason != printable(reason) or "internal error" in reason:
            yield f"{outcome.status} for the reason {reason!r}"
        longest = MOST_ACTIONS * max(
            settings.action_timeout_s, settings.answer_timeout_s, settings.llm_timeout_s
        )
        if outcome.mission_time_s > longest:
            yield f"it took {outcome.mission_time_s} s"
        if ticked_after_stop(records):
            yield "ticked after a stop"
        seen = looked_at(records, dict(self._robot.goals), self._robot.inner.views)
        yield from false_searches(map(self._witness.in_names, (*self._witness.said, reason)), seen)
        if outcome.status == MissionStatus.DONE:
            yield from self._not_done(outcome)
        stopped = outcome.status == MissionStatus.STOPPED
        if self._model and self._model.failed and not (outcome.model_failure or stopped):
            yield "the model failed, and the outcome does not say so"
        if not self._model and outcome.model_failure:
            yield f"there is no model, but {outcome.model_failure!r}"

    def _not_done(self, outcome: Outcome) -> Iterator[str]:
        """Why what is called done is not done."""
        world, name = self._world, outcome.object or ""
        match outcome.kind:
            case CommandKind.BRING if (place := world.resting_place(name)) != "delivery":
                if f"at {place}" not in self._witness.in_names(outcome.reason):
                    yield f"brought, but it is at {place}: {outcome.reason}"
            case CommandKind.TAKE if world.held != name:
                yield f"taken, but it holds {world.held}"
            case CommandKind.FIND if outcome.location not in self._witness.was_at[name]:
                if world.held != name:
                    yield f"found at {outcome.location}, where it never was"

    def _at_rest(self) -> Iterator[str]:
        yield from self._body_at_rest()
        if self._inbox._open:
            yield f"requests {sorted(self._inbox._open)} are still open"
        yield from self._unheard()

    def _unheard(self) -> Iterator[str]:
        if any(isinstance(event, StopRequested) for event in self._inbox.take_all()):
            yield "a stop was not heard"

    def _body_at_rest(self) -> Iterator[str]:
        struck = self._chaos.struck
        could_halt = not struck & {"start", "robot hangs", "robot fails", "cancel"}
        if self._world.busy and (could_halt or not self._robot.halts):
            yield f"not at rest, {self._robot.halts} halts"

    def _of_the_hand(self) -> Iterator[str]:
        believed, held = self._session._before.in_hand, self._world.held
        if "holding" in self._chaos.struck:
            return
        if bool(believed) != bool(held) or (believed not in (held, SOMETHING) and held):
            yield f"it believes that it holds {believed}, and holds {held}"

    def _all_is_well_again(self) -> Iterator[str]:
        """When nothing goes wrong any more, a thing that lies about is brought."""
        self._chaos.rate, self._person.helpful = 0.0, 1.0
        self._chaos._stops_at.clear()
        self._inbox.take_all()
        if self._faults:
            self._faults._chances.clear()
        if self._settings.action_timeout_s < 60:
            return
        world = self._world
        here = [n for n in self._home.objects if world.resting_place(n) not in (None, FLOOR)]
        name = world.held or self._chance.choice(here)
        self._begin()
        outcome = self._session.run(f"Bring the {name}")
        yield from self._judge(outcome)
        if outcome.status != MissionStatus.DONE:
            yield f"{name} is not brought: {outcome.reason}"


def _whole(folder: Path, outcome: Outcome) -> Iterator[str]:
    """What is wrong with the recording of a mission."""
    with (folder / "mission.mcap").open("rb") as file:
        summary = make_reader(file).get_summary()
    if summary is None or summary.statistics is None:
        yield "the mcap has no summary"
    kept = Run(folder).outcome()
    if kept != outcome:
        yield f"the mcap's outcome is {kept}"
    if json.loads((folder / "outcome.json").read_text())["reason"] != outcome.reason:
        yield "outcome.json tells another reason"
    again = replay(folder)
    if again.parting is not None or again.notes:
        yield f"the replay is not the same: {printable(replay_text(again))}"


def faults(chance: random.Random, home: Home, kinds: Sequence[str]) -> Iterator[str]:
    """Orders of what goes wrong in the world, as `--fault` has them."""
    doors = ["-".join(rooms) for rooms in doors_between(home.rooms, home.doors).values()]
    things, places = sorted(home.objects), [place.name for place in home.places()]
    for kind in chance.sample(kinds, chance.choice((0, 0, 1, 2, 3))):
        value = {
            "moved": f"={chance.choice(things)}:{chance.choice(places)}",
            "blocked": f"={chance.choice(doors)}",
            "crate": f"={chance.uniform(0, 8):.1f},{chance.uniform(0, 8):.1f}",
            "slip": f"={chance.choice((0.3, 1))}",
            "stuck": f"=joint{chance.randint(1, 7)}",
            "noise": "=0.02",
            "miss": f"={chance.choice((0.2, 0.9))}",
        }.get(kind, "")
        start = chance.randint(0, 40)
        span = chance.choice(("", f"@{start}", f"@{start}-{start + chance.randint(1, 40)}"))
        with contextlib.suppress(InputError):
            parse_faults([order := f"{kind}{value}{span}"], home)
            yield order


def _placement(chance: random.Random, home: Home) -> dict[str, str]:
    """Some things are elsewhere than the home file says."""
    if chance.random() < 0.5:
        return {}
    places = [place.name for place in home.places()]
    placed: dict[str, Any] = {}
    for name in chance.sample(sorted(home.objects), 3):
        trial = {**placed, name: chance.choice(places)}
        with contextlib.suppress(InputError):
            with_placement(home, trial).arrangement()
            placed = trial
    return placed


@contextlib.contextmanager
def watchdog() -> Iterator[None]:
    """Break off what does not end; only in a main thread."""

    def hung(number: int, frame: FrameType | None) -> None:
        raise HungError(f"no end after {LONGEST_S:g} s")

    before = signal.signal(signal.SIGALRM, hung)
    signal.setitimer(signal.ITIMER_REAL, LONGEST_S * MOST_MISSIONS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
