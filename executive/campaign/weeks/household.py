"""Simulates one household: ten commands a day, things that people move, a robot that remembers.

Between commands, the places of things and the robot's memory are kept, and within a day the robot's
position. Each morning the robot is at its start, and a new session begins.
"""

import io
import random
from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path
from tempfile import TemporaryDirectory

from executive.app.session import Session
from executive.campaign.blocks import label_of, truth_of
from executive.campaign.observer import Observed
from executive.campaign.policies import policy_named
from executive.campaign.truth import completed, whereabouts
from executive.campaign.weeks.lived import COMMANDS_A_DAY, Line, Lived
from executive.config import Settings
from executive.events import Inbox
from executive.interfaces.llm import LanguageModel
from executive.records import Record, Tick
from executive.types.knowledge import Source
from executive.types.outcome import Outcome
from kb.facts import Fact, FactStore
from kb.llm.open import model_for_missions
from logs.recorder import Stamp
from sim.home.arrangement import Spot
from sim.home.home_file import load_home
from sim.home.state import HomeState, read_state, write_state

BEGIN_S = 4_102_704_000.0
"""Monday, 2100-01-04 (UTC), in the future: a home's time is never before the current time."""
DAY_S, HOUR_S = 86_400.0, 3600.0
WAKING = (7.0, 22.0)
"""The hours of the day between which commands are given."""
MOST_LOOKED_BACK = 10_000
SURE = 0.5
"""A place below this probability does not count as believed: the robot looks there in passing."""


@dataclass(frozen=True, slots=True)
class Order:
    """A command and when it is given (hour of the day)."""

    hour: float
    command: str


@dataclass(frozen=True, slots=True)
class Household:
    """A household with its robot.

    Attributes:
        settings: settings of its missions; the policy overrides some.
        policy: name of the policy.
        days: number of days to simulate.
    """

    settings: Settings
    policy: str
    days: int

    @property
    def settings_used(self) -> Settings:
        """The settings, overridden by those of the policy."""
        return policy_named(self.policy).applied_to(self.settings)

    @property
    def name(self) -> tuple[str, str, str, int]:
        """What identifies it in the journal's lines."""
        used = self.settings_used
        llm = label_of(used.llm) if used.uses_llm else "none"
        return self.policy, label_of(self.settings.home), llm, self.settings.seed

    def run(self, before: Sequence[Line]) -> Iterator[Line]:
        """Run the days that are not complete in `before`."""
        return live(self, before)

    def orders(self, day: int) -> tuple[Order, ...]:
        """The commands of a day; the same for every policy."""
        chance = random.Random(f"{self.settings.seed} {day}")
        things = tuple(load_home(self.settings.home).objects)
        hours = sorted(chance.uniform(*WAKING) for _ in range(COMMANDS_A_DAY))
        verbs = ("Find", "Bring")
        return tuple(
            Order(hour, f"{chance.choice(verbs)} the {chance.choice(things)}") for hour in hours
        )


def live(household: Household, before: Sequence[Line] = ()) -> Generator[Line, None, None]:
    """Run the commands of all days that are not complete in `before`, one per step.

    Raises:
        ExecutiveError: if the settings, the home or the model file are wrong.
    """
    mine = [line for line in before if line.lived.household == household.name]
    whole: list[Line] = []
    for day, lines in groupby(mine, key=lambda line: line.lived.day):
        of_the_day = list(lines)
        if day * COMMANDS_A_DAY != len(whole) or len(of_the_day) < COMMANDS_A_DAY:
            break
        whole += of_the_day
    inbox = Inbox()
    model = model_for_missions(household.settings_used, inbox)
    try:
        with TemporaryDirectory() as folder:
            life = _Life(household, Path(folder), inbox, model, whole)
            for day in range(len(whole) // COMMANDS_A_DAY, household.days):
                yield from life.day(day)
    finally:
        if model:
            model.close()


@dataclass
class _Watch:
    """A sink that notes each candidate place with its source, and whether it was believed."""

    observed: Observed = field(default_factory=Observed)
    named: dict[str, tuple[str, bool]] = field(default_factory=dict)
    """For each place, its source, and whether its probability was at least `SURE` or not given."""

    def begin(self) -> None:
        """Begin a mission."""
        self.observed, self.named = Observed(), {}

    def write(self, stamp: Stamp, record: Record) -> None:
        """Add a record; the first source of a place counts."""
        self.observed.write(stamp, record)
        if isinstance(record, Tick) and (candidate := record.situation.get("candidate")):
            likely = candidate["probability"]  # None in the paper's stages
            sure = likely is None or likely >= SURE
            self.named.setdefault(candidate["place"], (candidate["source"], sure))

    def flush(self) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""

    def in_vain(self, source: str, outcome: Outcome) -> int:
        """1 if the robot visited a believed place from this source in vain, else 0."""
        wrong = (place for place in outcome.visited if place != outcome.location)
        return int(any(self.named.get(place) == (source, True) for place in wrong))


class _Life:
    """The state of a household between days: its home and memory files."""

    def __init__(
        self,
        household: Household,
        folder: Path,
        inbox: Inbox,
        model: LanguageModel | None,
        before: Sequence[Line],
    ) -> None:
        self._household, self._inbox, self._model = household, inbox, model
        self._state, self._memory = folder / "home.toml", folder / "facts.sqlite"
        self._home = load_home(household.settings.home)
        time_s = before[-1].time_s if before else BEGIN_S
        things = before[-1].things if before else self._home.placement
        spots = {name: Spot(furniture=place) for name, place in things.items()}
        write_state(self._state, HomeState(home=self._home.name, time_s=time_s, objects=spots))
        store = FactStore(self._memory)
        store.load(fact for line in before for fact in line.facts)
        store.close()
        self._time_s = time_s

    def day(self, day: int) -> Generator[Line, None, None]:
        """Run all commands of a day."""
        used = self._household.settings_used
        kept = {"home_state": self._state, "memory": self._memory}
        settings = used.model_copy(update=kept)
        policy = policy_named(self._household.policy)
        watch = _Watch()
        with Session(
            settings,
            inbox=self._inbox,
            model=self._model,
            out=io.StringIO(),
            recorded=False,
            sinks=[watch],
            change=policy,
        ) as session:
            store = FactStore(self._memory, learns=False)
            _, last = store.since(0, 1)
            for turn, order in enumerate(self._household.orders(day)):
                at_s = BEGIN_S + day * DAY_S + order.hour * HOUR_S
                session.embodiment.pause(max(0.0, at_s - self._time_s))
                watch.begin()
                outcome = session.run(order.command)
                new, last = store.since(last, MOST_LOOKED_BACK)
                yield self._line(day, turn, order, outcome, session, watch, new)
            store.close()

    def _line(
        self,
        day: int,
        turn: int,
        order: Order,
        outcome: Outcome,
        session: Session,
        watch: _Watch,
        facts: tuple[Fact, ...],
    ) -> Line:
        world, (policy, home, llm, seed) = truth_of(session), self._household.name
        state = read_state(self._state, self._home)
        assert state
        self._time_s = state.time_s
        observed = watch.observed
        price_s = self._household.settings.question_s
        lived = Lived(
            policy=policy,
            home=home,
            llm=llm,
            seed=seed,
            day=day,
            turn=turn,
            hour=round(order.hour, 4),
            command=order.command,
            object=outcome.object or "",
            status=str(outcome.status),
            reason=outcome.reason,
            completed=completed(outcome, lambda name: whereabouts(name, world)),
            source=str(outcome.source or ""),
            location=outcome.location or "",
            inquiries=outcome.inquiries,
            visits=len(outcome.visited),
            visited=" ".join(outcome.visited),
            stale=watch.in_vain(Source.MEMORY, outcome),
            misguided=watch.in_vain(Source.HABITS, outcome),
            search_s=round(observed.searching_s, 3),
            cost_s=round(observed.searching_s + price_s * outcome.inquiries, 3),
            mission_time_s=outcome.mission_time_s,
            wall_time_s=round(outcome.wall_time_s, 3),
        )
        things = {name: spot.furniture for name, spot in state.objects.items()}
        return Line(lived, state.time_s, things, facts)
