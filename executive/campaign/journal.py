"""A campaign's truth on disk: one JSON line for each mission that has ended.

A line is appended in one write when its mission ends, by whichever process ran it, so that whatever
kills the campaign costs at most the missions under way. The tables are made from it.
"""

import csv
import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import get_type_hints

import pyarrow.parquet as pq

from executive.campaign.appending import LineFile
from executive.campaign.rows import misfit, table_of
from executive.config import KnowledgeSystem

CRASHED = "crashed"
"""Status of a mission that ended in an exception, beside those of an Outcome."""


@dataclass(frozen=True, slots=True)
class Key:
    """Which mission of a campaign."""

    policy: str
    home: str
    llm: str
    system: KnowledgeSystem
    defaults: bool
    seed: int
    command: str


@dataclass(frozen=True, slots=True)
class Row:
    """How one mission of a campaign went; times in seconds. What is not known is 0 or empty."""

    policy: str
    """Who says where to look, as `executive.campaign.policies` names it."""
    home: str
    llm: str
    """The language model as the settings name it; `none` where none is asked."""
    system: str
    defaults: bool
    seed: int
    command: str
    turn: int
    """Its place in the order of its block's commands, from 0."""
    kind: str = ""
    object: str = ""
    status: str = CRASHED
    """done, not_done, not_understood, stopped, or crashed."""
    reason: str = ""
    completed: bool = False
    """Done by the world's truth, as `truth.py` has it; `status` is what the robot said."""
    truth: str = ""
    """Where the thing truly was when the mission ended: furniture, `hand`, or nowhere."""
    source: str = ""
    location: str = ""
    inquiries: int = 0
    visits: int = 0
    visited: str = ""
    """Pieces of furniture in the order of the visits, with blanks between."""
    failed_visits: int = 0
    """Places that the robot set out for and could not get to, such as those that do not exist."""
    named: int = 0
    """Names that the language model wrote in its lists."""
    invented: int = 0
    """Those of them that no room and no furniture of the home goes by."""
    llm_calls: int = 0
    generated_tokens: int = 0
    llm_s: float = 0.0
    """Wall time inside the language model."""
    thinking_time_s: float = 0.0
    """Mission time from asking the model for places until it has answered."""
    thought_moving_s: float = 0.0
    """How much of it the robot used for something else, too."""
    driving_s: float = 0.0
    looking_s: float = 0.0
    handling_s: float = 0.0
    mission_time_s: float = 0.0
    wall_time_s: float = 0.0
    search_s: float = 0.0
    """Of going to places and looking there, until the thing was seen, or again after a miss."""
    cost_s: float = 0.0
    """The same, and for each question what it costs by the settings."""
    sure: float = 0.0
    """Before the first look: how likely the likeliest place was thought to be; 0: no plan."""
    sure_of_it: float = 0.0
    """The same of the place where the thing truly was."""
    as_likely: int = 1
    """How many places were as likely as the likeliest; in earlier campaigns nobody counted."""
    path_m: float = 0.0
    """How far the robot drove."""
    shortest_m: float = 0.0
    """How far it had to: to the thing, and on to where the command ends."""
    model: str = ""
    """The language model's own name."""
    run_dir: str = ""
    model_failure: str = ""
    """Why the language model was of no help; such a mission is no result, and is run again."""

    @property
    def key(self) -> Key:
        """Which mission it was."""
        system = KnowledgeSystem(self.system)
        where = (self.policy, self.home, self.llm)
        return Key(*where, system, self.defaults, self.seed, self.command)

    @property
    def spl(self) -> float:
        """Success weighted by path length, 0 to 1; of one mission.

        Anderson et al., "On Evaluation of Embodied Navigation Agents", 2018.
        """
        longer = max(self.path_m, self.shortest_m)
        return self.completed * (self.shortest_m / longer if longer else 1.0)


_KINDS: dict[str, type] = get_type_hints(Row)


@dataclass(frozen=True, slots=True)
class Entry:
    """A line of the journal: the row, and what was said between robot and language model."""

    row: Row
    exchanges: tuple[tuple[str, str], ...] = ()
    """Inquiry and reply of each call in which the model wrote."""


class Journal(LineFile):
    """The file with the entries."""

    def append(self, entry: Entry) -> None:
        """Add one, as `LineFile.write` does."""
        self.write(json.dumps({**asdict(entry.row), "exchanges": entry.exchanges}))

    def entries(self) -> list[Entry]:
        """One entry for each mission that has ended, in the order in which they first did.

        Of several of one mission the last counts, but one without a working model never in the
        place of a result. Damaged lines are left out.
        """
        found: dict[Key, Entry] = {}
        for line in self.lines():
            if isinstance(entry := read_entry(line), Entry):
                before = found.get(entry.row.key)
                if before is None or before.row.model_failure or not entry.row.model_failure:
                    found[entry.row.key] = entry
        return list(found.values())

    def damage(self) -> list[str]:
        """A sentence for each line that is no entry."""
        read = enumerate(map(read_entry, self.lines()), 1)
        return [f"{self.file}:{n}: is not a mission: {e}" for n, e in read if isinstance(e, str)]


def read_entry(line: bytes) -> Entry | str:
    """The entry of a line, or why it is none."""
    try:
        values = json.loads(line)
        exchanges = tuple((str(said), str(reply)) for said, reply in values.pop("exchanges"))
        row = Row(**values)
        row.key  # noqa: B018  names a system that exists
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        return f"{type(error).__name__}: {error}"
    return misfit(row, _KINDS) or Entry(row, exchanges)


def in_order(rows: Iterable[Row], policies: Sequence[str] = ()) -> list[Row]:
    """Sorted by what a campaign varies, whatever order the missions ended in.

    Args:
        rows: of any number of policies.
        policies: those that come first, in this order.
    """
    systems, ranks = list(KnowledgeSystem), {name: rank for rank, name in enumerate(policies)}

    def place(row: Row) -> tuple[int, str, str, str, int, bool, int, int]:
        first = ranks.get(row.policy, len(ranks))
        which = (first, row.policy, row.home, row.llm)
        return *which, systems.index(row.key.system), row.defaults, row.seed, row.turn

    return sorted(rows, key=place)


def _inert(value: object) -> object:
    """What a spreadsheet does not take for a formula."""
    return f"'{value}" if isinstance(value, str) and value[:1] in tuple("=+-@\t\r") else value


def read_table(file: Path) -> list[Row]:
    """The rows of a `results.parquet`."""
    return [Row(**row) for row in pq.read_table(file).to_pylist()]


def write_tables(rows: Sequence[Row], folder: Path) -> None:
    """Write `results.csv` and `results.parquet`, one row a mission."""
    names = [field.name for field in fields(Row)]
    with (folder / "results.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, names)
        writer.writeheader()
        for row in rows:
            writer.writerow({key: _inert(value) for key, value in asdict(row).items()})
    pq.write_table(table_of(Row, rows), folder / "results.parquet")
