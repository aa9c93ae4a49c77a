"""One household of a campaign: a system, a situation and a seed, and all commands in turn.

What is kept from command to command, and what is not:

- The home is put back as its file says, with the robot at its start and a new simulated person.
- What the robot saw or learned in a mission is forgotten: every mission has its own Session.
- The language model stays loaded. Only okb+llm+mem is given the dialogue of the commands before.
"""

import io
import random
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from executive.app import Session, build_model
from executive.config import KnowledgeSystem, Settings
from executive.events import Inbox
from executive.interfaces import LanguageModel
from executive.journal import CRASHED, Entry, Key, Row
from executive.records import LlmCall, Record
from executive.types import ChatRequest, Message, Outcome, Replied, Scored, Status
from kb.advisor import PlaceAdvisor
from logs.recorder import Stamp


@dataclass(frozen=True, slots=True)
class Household:
    """Who lives where, and what is asked of the robot."""

    settings: Settings
    """Of its missions: system, situation, seed and all else."""
    commands: tuple[str, ...]
    """In the order in which they are given."""
    recorded: bool = False
    """Whether each mission leaves a folder in `settings.runs`."""

    @property
    def keys(self) -> tuple[Key, ...]:
        """Its missions."""
        s = self.settings
        return tuple(Key(s.knowledge, s.defaults, s.seed, words) for words in self.commands)


def shuffled(commands: Iterable[str], seed: int) -> tuple[str, ...]:
    """The commands in the order that this seed gives, the same for every system."""
    order = list(commands)
    random.Random(seed).shuffle(order)
    return tuple(order)


@dataclass
class Calls:
    """A sink that keeps the finished calls of the language model."""

    results: list[Replied | Scored] = field(default_factory=list)

    def write(self, stamp: Stamp, record: Record) -> None:
        """Keep it if it is a call."""
        if isinstance(record, LlmCall):
            self.results.append(record.result)

    def flush(self) -> None:
        """Nothing to bring to disk."""

    def close(self) -> None:
        """Nothing to close."""

    def entry(self, row: Row) -> Entry:
        """The row with what the calls cost, and what was said in them."""
        usage = [call.usage for call in self.results]
        written = [call for call in self.results if isinstance(call, Replied)]
        return Entry(
            replace(
                row,
                generated_tokens=sum(u.output_tokens for u in usage),
                llm_s=round(sum(u.total_s for u in usage), 3),
            ),
            tuple((call.request.messages[-1].content, call.text) for call in written),
        )


def run(household: Household, before: Iterable[Entry] = ()) -> Iterator[Entry]:
    """Run the missions of a household that are not in `before`, each when it is asked for.

    Raises:
        ExecutiveError: if the settings, the home or the model file are wrong; what goes wrong in
            a mission is an entry instead.
    """
    ended = {entry.row.key: entry for entry in before}
    rest = _Rest(household)
    try:
        for turn, key in enumerate(household.keys):
            if key in ended:
                rest.recall(ended[key])
            else:
                yield rest.mission(turn, key)
    finally:
        rest.close()


class _Rest:
    """What outlives the missions of a household: model, and advisor with its memory."""

    def __init__(self, household: Household) -> None:
        self._household = household
        self._inbox = Inbox()
        self._model: LanguageModel | None = build_model(household.settings, self._inbox)
        self._advisor: PlaceAdvisor | None = None
        self._to_recall: list[tuple[str, str]] = []

    def recall(self, entry: Entry) -> None:
        """Bring the dialogue of a mission that was run earlier back to memory."""
        self._to_recall += entry.exchanges

    def mission(self, turn: int, key: Key) -> Entry:
        calls = Calls()
        session = Session(
            self._household.settings,
            inbox=self._inbox,
            model=self._model,
            out=io.StringIO(),
            recorded=self._household.recorded,
            sinks=[calls],
        )
        self._share_memory(session)
        try:
            row = _row(turn, key, session.run(key.command), session)
        except Exception as error:
            row = _crash(turn, key, error)
            self._inbox.take_all()  # what the broken mission left
        finally:
            session.world.close()
        return calls.entry(row)

    def _share_memory(self, session: Session) -> None:
        self._advisor = session.advisor = self._advisor or session.advisor
        for said, reply in self._to_recall:
            assert self._advisor
            self._advisor.remember(ChatRequest("recalled", (Message("user", said),)), reply)
        self._to_recall.clear()

    def close(self) -> None:
        if self._model:
            self._model.close()


def _row(turn: int, key: Key, outcome: Outcome, session: Session) -> Row:
    true_place = session.home.placement.get(outcome.object or "")
    return Row(
        system=str(key.system),
        defaults=key.defaults,
        seed=key.seed,
        command=key.command,
        turn=turn,
        kind=str(outcome.kind or ""),
        object=outcome.object or "",
        status=str(outcome.status),
        reason=outcome.reason,
        completed=outcome.status == Status.DONE and outcome.location == true_place,
        source=str(outcome.source or ""),
        location=outcome.location or "",
        inquiries=outcome.inquiries,
        visits=len(outcome.visited),
        visited=" ".join(outcome.visited),
        llm_calls=outcome.llm_calls,
        thinking_time_s=outcome.thinking_time_s,
        mission_time_s=outcome.mission_time_s,
        wall_time_s=outcome.wall_time_s,
        model=session.model.name if session.model else "",
        run_dir=outcome.run_dir or "",
    )


def _crash(turn: int, key: Key, error: Exception) -> Row:
    system, reason = str(key.system), f"{type(error).__name__}: {error}"
    return Row(system, key.defaults, key.seed, key.command, turn, status=CRASHED, reason=reason)


def for_conditions(
    settings: Settings,
    systems: Iterable[KnowledgeSystem],
    commands: tuple[str, ...],
    seeds: int,
    runs: Path | None,
) -> tuple[Household, ...]:
    """Every household of a campaign, seed by seed, so that early tables are already fair."""
    chosen = tuple(systems)
    return tuple(
        Household(
            settings.model_copy(
                update={
                    "knowledge": system,
                    "defaults": defaults,
                    "seed": seed,
                    **({"runs": runs} if runs else {}),
                }
            ),
            shuffled(commands, seed),
            recorded=runs is not None,
        )
        for seed in range(seeds)
        for defaults in (False, True)
        for system in chosen
    )
