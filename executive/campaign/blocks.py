"""One block of a campaign: all commands in turn, with one system, situation and seed.

What is kept between the commands, and what is not:

- The home is reset to its file, with the robot at its start and a new simulated person.
- What the robot saw or learned in a mission is forgotten: every mission has its own Session.
- The language model stays loaded. Only okb+llm+mem gets the dialogue of the commands before.
"""

import io
import random
from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property, partial
from math import dist
from pathlib import Path
from typing import Any

from executive.app.parts import Parts
from executive.app.session import Session
from executive.campaign.draws import drawn
from executive.campaign.journal import CRASHED, Entry, Key, Row
from executive.campaign.observer import Observed
from executive.campaign.policies import policy_named
from executive.campaign.routes import routes_in
from executive.campaign.timeless import Timeless
from executive.campaign.truth import completed, shortest_m, whereabouts
from executive.config import KnowledgeSystem, Settings
from executive.errors import InputError
from executive.events import Inbox
from executive.interfaces.simulation import SimulatedHome
from executive.types.llm import ChatRequest, Message
from executive.types.outcome import Outcome
from kb.llm.open import model_for_missions
from sim.home.home import Home
from sim.home.home_file import load_home


@dataclass(frozen=True, slots=True)
class Block:
    """The settings and commands of a block."""

    settings: Settings
    """Settings of its missions, with system, situation and seed; the policy may override some."""
    commands: tuple[str, ...]
    """The commands, in order."""
    policy: str = "ours"
    recorded: bool = False
    """Whether each mission leaves a folder in `settings.runs`."""
    draws: bool = False
    """Whether the requested thing is at a place that the seed draws from the survey.

    If so, the model's computation takes no mission time, so that the figures do not depend on the
    machine."""

    @property
    def keys(self) -> tuple[Key, ...]:
        """The keys of its missions."""
        s, used = self.settings, self.settings_used
        where = (self.policy, label_of(s.home), label_of(used.llm) if used.uses_llm else "none")
        return tuple(Key(*where, s.knowledge, s.defaults, s.seed, w) for w in self.commands)

    def run(self, before: Sequence[Entry]) -> Iterator[Entry]:
        """Run the missions that have no result in `before`."""
        return run(self, entries_of(self, before))

    @property
    def settings_used(self) -> Settings:
        """The settings, overridden by those of the policy."""
        return policy_named(self.policy).applied_to(self.settings)


def entries_of(block: Block, entries: Sequence[Entry]) -> list[Entry]:
    """The entries among these that are results of the block's missions."""
    keys = set(block.keys)
    return [e for e in entries if e.row.key in keys and not e.row.model_failure]


def label_of(name_or_file: str) -> str:
    """The name of a home or model in tables: its name, or its file's without folder and suffix."""
    suffixes = (".toml", ".gguf")
    return Path(name_or_file).stem if name_or_file.endswith(suffixes) else name_or_file


def shuffled(commands: Iterable[str], seed: int) -> tuple[str, ...]:
    """The commands in the order that this seed gives, the same for every system."""
    order = list(commands)
    random.Random(seed).shuffle(order)
    return tuple(order)


def run(block: Block, before: Iterable[Entry] = ()) -> Generator[Entry, None, None]:
    """Run the missions of a block that are not in `before`, one per step of the generator.

    Raises:
        ExecutiveError: if the settings, the home or the model file are wrong; an exception in a
            mission becomes an entry instead.
    """
    ended = {entry.row.key: entry for entry in before}
    rest = _BlockRun(block)
    try:
        for turn, key in enumerate(block.keys):
            if key in ended:
                rest.recall(ended[key])
            else:
                yield rest.mission(turn, key)
    finally:
        rest.close()


class _BlockRun:
    """Runs the rest of a block's missions, and keeps model and dialogue between them."""

    def __init__(self, block: Block) -> None:
        self._recorded = block.recorded
        self._settings = block.settings_used
        self._draws = block.draws
        self._question_s = block.settings.question_s  # for all policies, whatever they set
        self._policy_name = block.policy
        self._policy = policy_named(block.policy)
        self._inbox = Inbox()
        opened = timeless if block.draws else model_for_missions
        self._model = opened(self._settings, self._inbox)
        self._dialogue: list[tuple[str, str]] = []

    def recall(self, entry: Entry) -> None:
        """Add the dialogue of a mission that has ended."""
        self._dialogue += entry.exchanges

    def mission(self, turn: int, key: Key) -> Entry:
        observed = Observed()
        with Session(
            self._settings_of(key),
            inbox=self._inbox,
            model=self._model,
            out=io.StringIO(),
            recorded=self._recorded,
            sinks=[observed],
            policy=self._policy_name,
            change=self._choose,
        ) as session:
            world = truth_of(session)
            try:
                row = _row(
                    turn, key, session.run(key.command), session, world, observed, self._question_s
                )
            except Exception as error:
                row = crash(turn, key, error, str(session.folder or ""))
                self._inbox.take_all()  # events that the crashed mission left
        entry = Entry(row, observed.exchanges())
        self.recall(entry)
        return entry

    def _settings_of(self, key: Key) -> Settings:
        """The settings of a mission, with a drawn place of its thing if the block draws places."""
        if not self._draws:
            return self._settings
        thing = key.command.rpartition(" ")[2]
        place = drawn(self._home, thing, key.seed)
        return self._settings.model_copy(update={"place": {**self._settings.place, **place}})

    @cached_property
    def _home(self) -> Home:
        return load_home(self._settings.home)

    def _choose(self, parts: Parts) -> Parts:
        """Apply the policy, and give its advice the dialogue so far.

        The advice keeps it if the system has a memory.
        """
        chosen = self._policy(parts)
        if chosen.advice:
            for said, reply in self._dialogue:
                request = ChatRequest("recalled", (Message("user", said),))
                chosen.advice.lister.remember(request, reply)
        return chosen

    def close(self) -> None:
        if self._model:
            self._model.close()


def timeless(settings: Settings, inbox: Inbox) -> Timeless | None:
    """The model of the missions, if they have one, wrapped so that it takes no mission time.

    Raises:
        ExecutiveError: as `model_for_missions`.
    """
    within = Inbox()
    model = model_for_missions(settings, within)
    return Timeless(model, within, inbox) if model else None


def truth_of(session: Session) -> SimulatedHome:
    """The simulated world with the ground truth about a mission.

    Raises:
        InputError: if the world is not simulated.
    """
    if session.embodiment.truth is None:
        raise InputError(
            "setting 'world'",
            f"{session.settings.world} is not simulated: nobody knows what truly came of a mission",
            "run campaigns in physics or fake",
        )
    return session.embodiment.truth


def _row(
    turn: int,
    key: Key,
    outcome: Outcome,
    session: Session,
    world: SimulatedHome,
    observed: Observed,
    question_s: float,
) -> Row:
    truth = whereabouts(outcome.object or "", world)
    routes = routes_in(session.settings.home)
    usage = [call.usage for call in observed.calls]
    parts = session.parts
    known = parts.knowledge.place_names.exactly
    invented = [n for n in observed.names if not (known(n).furniture or known(n).rooms)]
    sure, sure_of_it, alike = observed.believed(parts.home.placement.get(outcome.object or ""))
    leg_m = routes.length if session.embodiment.jumps else dist
    return Row(
        **_of_key(key),
        turn=turn,
        kind=str(outcome.kind or ""),
        object=outcome.object or "",
        status=str(outcome.status),
        reason=outcome.reason,
        completed=completed(outcome, partial(whereabouts, world=world)),
        truth=truth,
        source=str(outcome.source or ""),
        location=outcome.location or "",
        inquiries=outcome.inquiries,
        visits=len(outcome.visited),
        visited=" ".join(outcome.visited),
        failed_visits=observed.unreached,
        named=len(observed.names),
        invented=len(invented),
        llm_calls=outcome.llm_calls,
        generated_tokens=sum(u.output_tokens for u in usage),
        llm_s=round(sum(u.total_s for u in usage), 3),
        thinking_time_s=outcome.thinking_time_s,
        thought_moving_s=_thought_moving_s(outcome, observed),
        driving_s=round(observed.seconds["driving"], 3),
        looking_s=round(observed.seconds["looking"], 3),
        handling_s=round(observed.seconds["handling"], 3),
        mission_time_s=outcome.mission_time_s,
        wall_time_s=outcome.wall_time_s,
        search_s=round(observed.searching_s, 3),
        cost_s=round(observed.searching_s + question_s * outcome.inquiries, 3),
        sure=sure,
        sure_of_it=sure_of_it,
        as_likely=alike,
        path_m=round(observed.path_m(leg_m), 3),
        shortest_m=round(shortest_m(outcome, parts.home, routes), 3),
        model=parts.model.name if parts.model else "",
        run_dir=outcome.run_dir or "",
        model_failure=outcome.model_failure if key.llm != "none" else "",
    )


def _thought_moving_s(outcome: Outcome, observed: Observed) -> float:
    """How long the robot did something else while the model computed (s)."""
    return round(max(0.0, outcome.thinking_time_s - observed.seconds["thinking"]), 3)


def crash(turn: int, key: Key, error: Exception, run_dir: str = "") -> Row:
    """The row of a mission that ended in an exception."""
    reason = f"{type(error).__name__}: {error}"
    return Row(**_of_key(key), turn=turn, status=CRASHED, reason=reason, run_dir=run_dir)


def _of_key(key: Key) -> dict[str, Any]:
    return {**asdict(key), "system": str(key.system)}


def grid(
    settings: Sequence[Settings],
    policies: Sequence[str],
    systems: Sequence[KnowledgeSystem],
    commands: tuple[str, ...],
    seeds: int,
    runs: Path | None = None,
    draws: bool = False,
) -> tuple[Block, ...]:
    """All blocks of a campaign, seed by seed, so that early tables compare equal seeds.

    The system okb asks no model, so it is run once in each home, under the first policy.

    Args:
        settings: one for each home and language model.
        policies: names of the policies.
        systems: the paper's systems, or some of them.
        commands: the commands, each once.
        seeds: number of seeds.
        runs: folder for the recordings of missions; None: do not record.
        draws: whether things are at drawn places.
    """
    watched = {"runs": runs} if runs else {"camera_hz": 0.0}
    found = (
        Block(
            base.model_copy(
                update={"knowledge": system, "defaults": defaults, "seed": seed, **watched}
            ),
            shuffled(commands, seed),
            policy,
            recorded=runs is not None,
            draws=draws,
        )
        for seed in range(seeds)
        for defaults in (False, True)
        for base in settings
        for policy in policies
        for system in systems
        if system != KnowledgeSystem.OKB or policy == policies[0]
    )
    return tuple({block.keys: block for block in found}.values())
