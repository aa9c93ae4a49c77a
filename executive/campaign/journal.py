"""The journal of a campaign: one JSON line for each mission that has ended.

Whichever process ran a mission appends its line in one write when it ends, so that a kill costs at
most the running missions. The tables are made from the journal.
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
"""Status of a mission that ended in an exception; in addition to those of an Outcome."""


@dataclass(frozen=True, slots=True)
class Key:
    """Identifies a mission of a campaign."""

    policy: str
    home: str
    llm: str
    system: KnowledgeSystem
    defaults: bool
    seed: int
    command: str


@dataclass(frozen=True, slots=True)
class Row:
    """The results of one mission; times in seconds. Unknown values are 0 or empty."""

    policy: str
    """Name of the policy, one of `executive.campaign.policies` or a user's own."""
    home: str
    llm: str
    """The language model as the settings name it; `none` if none is used."""
    system: str
    defaults: bool
    seed: int
    command: str
    turn: int
    """Index among its block's commands, from 0."""
    kind: str = ""
    object: str = ""
    status: str = CRASHED
    """done, not_done, not_understood, stopped, or crashed."""
    reason: str = ""
    completed: bool = False
    """Whether it was done by the ground truth (`truth.py`); `status` is what the robot said."""
    truth: str = ""
    """Ground truth of the thing's place at the end: furniture, `hand`, or empty."""
    source: str = ""
    location: str = ""
    inquiries: int = 0
    visits: int = 0
    visited: str = ""
    """The visited furniture, in order, separated by spaces."""
    failed_visits: int = 0
    """Places that the robot could not reach, such as those that do not exist."""
    named: int = 0
    """Number of names in the language model's lists."""
    invented: int = 0
    """Number of these that are no room or furniture of the home."""
    llm_calls: int = 0
    generated_tokens: int = 0
    llm_s: float = 0.0
    """Wall time of the language model."""
    thinking_time_s: float = 0.0
    """Mission time from requests for places to the model until their ends."""
    thought_moving_s: float = 0.0
    """The part of it during which the robot did something else, too."""
    driving_s: float = 0.0
    looking_s: float = 0.0
    handling_s: float = 0.0
    mission_time_s: float = 0.0
    wall_time_s: float = 0.0
    search_s: float = 0.0
    """Mission time of driving to places and looking there, until the thing was seen; and again if
    it had to be searched for again."""
    cost_s: float = 0.0
    """`search_s`, plus the cost of each question by the settings."""
    sure: float = 0.0
    """Probability of the likeliest place before the first look; 0 without a plan."""
    sure_of_it: float = 0.0
    """The same of the thing's true place."""
    as_likely: int = 1
    """Number of places as likely as the likeliest; earlier campaigns have the default."""
    path_m: float = 0.0
    """Length of the robot's path (metres)."""
    shortest_m: float = 0.0
    """Length of the shortest path to the thing and on to the command's end (metres)."""
    model: str = ""
    """The name that the language model gives itself."""
    run_dir: str = ""
    model_failure: str = ""
    """Why the language model did not help; such a mission is not a result, and is run again."""

    @property
    def key(self) -> Key:
        """The key of the mission."""
        system = KnowledgeSystem(self.system)
        where = (self.policy, self.home, self.llm)
        return Key(*where, system, self.defaults, self.seed, self.command)

    @property
    def spl(self) -> float:
        """Success weighted by path length, in [0, 1], of one mission.

        Anderson et al., "On Evaluation of Embodied Navigation Agents", 2018.
        """
        longer = max(self.path_m, self.shortest_m)
        return self.completed * (self.shortest_m / longer if longer else 1.0)


_KINDS: dict[str, type] = get_type_hints(Row)


@dataclass(frozen=True, slots=True)
class Entry:
    """A line of the journal: the row, and the dialogue with the language model."""

    row: Row
    exchanges: tuple[tuple[str, str], ...] = ()
    """Request and reply of each chat call."""


class Journal(LineFile):
    """The file with the entries of a campaign."""

    def append(self, entry: Entry) -> None:
        """Append an entry, as `LineFile.write` does."""
        self.write(json.dumps({**asdict(entry.row), "exchanges": entry.exchanges}))

    def entries(self) -> list[Entry]:
        """One entry for each ended mission, in the order of their first entries.

        Of several entries of a mission the last counts, but one without a working model never
        replaces a result. Damaged lines are left out.
        """
        found: dict[Key, Entry] = {}
        for line in self.lines():
            if isinstance(entry := read_entry(line), Entry):
                before = found.get(entry.row.key)
                if before is None or before.row.model_failure or not entry.row.model_failure:
                    found[entry.row.key] = entry
        return list(found.values())

    def damage(self) -> list[str]:
        """A sentence for each line that is not an entry."""
        read = enumerate(map(read_entry, self.lines()), 1)
        return [f"{self.file}:{n}: is not a mission: {e}" for n, e in read if isinstance(e, str)]


def read_entry(line: bytes) -> Entry | str:
    """The entry in a line, or why there is none."""
    try:
        values = json.loads(line)
        exchanges = tuple((str(said), str(reply)) for said, reply in values.pop("exchanges"))
        row = Row(**values)
        row.key  # noqa: B018  raises ValueError for an unknown system
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        return f"{type(error).__name__}: {error}"
    return misfit(row, _KINDS) or Entry(row, exchanges)


def in_order(rows: Iterable[Row], policies: Sequence[str] = ()) -> list[Row]:
    """The rows sorted by what a campaign varies.

    Args:
        rows: rows of any policies.
        policies: policies to put first, in this order.
    """
    systems, ranks = list(KnowledgeSystem), {name: rank for rank, name in enumerate(policies)}

    def place(row: Row) -> tuple[int, str, str, str, int, bool, int, int]:
        first = ranks.get(row.policy, len(ranks))
        which = (first, row.policy, row.home, row.llm)
        return *which, systems.index(row.key.system), row.defaults, row.seed, row.turn

    return sorted(rows, key=place)


def _not_a_formula(value: object) -> object:
    """The value, quoted if a spreadsheet would take it for a formula."""
    return f"'{value}" if isinstance(value, str) and value[:1] in tuple("=+-@\t\r") else value


def read_table(file: Path) -> list[Row]:
    """The rows of a `results.parquet`."""
    return [Row(**row) for row in pq.read_table(file).to_pylist()]


def write_tables(rows: Sequence[Row], folder: Path) -> None:
    """Write `results.csv` and `results.parquet`, one row per mission."""
    names = [field.name for field in fields(Row)]
    with (folder / "results.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, names)
        writer.writeheader()
        for row in rows:
            writer.writerow({key: _not_a_formula(value) for key, value in asdict(row).items()})
    pq.write_table(table_of(Row, rows), folder / "results.parquet")
