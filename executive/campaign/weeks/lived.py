"""The journal of a campaign of weeks: one JSON line for each command to a household.

A line has the results of the mission, the places of all things after it, and the new facts in the
memory. So the lines of a household are enough to continue from there.
"""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path
from typing import Any, get_type_hints

import pyarrow.parquet as pq

from executive.campaign.appending import LineFile
from executive.campaign.rows import misfit, table_of
from kb.facts import Fact, FactKind

COMMANDS_A_DAY = 10
DAYS_A_WEEK = 7


@dataclass(frozen=True, slots=True)
class Lived:
    """The results of one command to a household; times in seconds."""

    policy: str
    home: str
    llm: str
    seed: int
    day: int
    """From 0."""
    turn: int
    """Index of the command in its day, from 0."""
    hour: float
    """Hour of the day at which the command was given."""
    command: str
    object: str = ""
    status: str = ""
    reason: str = ""
    completed: bool = False
    """Whether it was done by the ground truth."""
    source: str = ""
    """The source of the place where it was found."""
    location: str = ""
    inquiries: int = 0
    visits: int = 0
    visited: str = ""
    stale: int = 0
    """1 if the robot looked in vain at a place that it believed from its memory, else 0."""
    misguided: int = 0
    """1 if it looked in vain at a place that it believed from people's habits, else 0."""
    search_s: float = 0.0
    cost_s: float = 0.0
    mission_time_s: float = 0.0
    wall_time_s: float = 0.0

    @property
    def household(self) -> tuple[str, str, str, int]:
        """What identifies the household."""
        return self.policy, self.home, self.llm, self.seed

    @property
    def week(self) -> int:
        """From 0."""
        return self.day // DAYS_A_WEEK


_KINDS: dict[str, type] = get_type_hints(Lived)


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the journal.

    Attributes:
        lived: how the command went.
        time_s: the end of the mission by the home's clock (UTC, s).
        things: the place of each thing then.
        facts: the new facts in the memory.
    """

    lived: Lived
    time_s: float
    things: dict[str, str]
    facts: tuple[Fact, ...]

    def to_json(self) -> str:
        """The line as JSON."""
        facts = [[str(f.kind), f.object, f.place, f.time_s] for f in self.facts]
        kept = {"time_s": self.time_s, "things": self.things, "facts": facts}
        return json.dumps({**asdict(self.lived), **kept})


def read_line(text: bytes) -> Line | str:
    """Parse a line of the journal; a string says why it is not one."""
    try:
        values: dict[str, Any] = json.loads(text)
        time_s, things = float(values.pop("time_s")), dict(values.pop("things"))
        facts = tuple(Fact(FactKind(k), o, p, float(t)) for k, o, p, t in values.pop("facts"))
        lived = Lived(**values)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        return f"{type(error).__name__}: {error}"
    if wrong := misfit(lived, _KINDS):
        return wrong
    if not isfinite(time_s):
        return "time_s is no time"
    return Line(lived, time_s, things, facts)


class Diary(LineFile):
    """The file with the lines of all households."""

    def append(self, line: Line) -> None:
        """Append a line, as `LineFile.write` does."""
        self.write(line.to_json())

    def entries(self) -> list[Line]:
        """One line for each command, the last if there are several; damaged ones are left out.

        They are sorted by household, day and turn.
        """
        found = {}
        for text in self.lines():
            if isinstance(line := read_line(text), Line):
                one = line.lived
                found[one.household, one.day, one.turn] = line
        return [found[key] for key in sorted(found)]

    def damage(self) -> list[str]:
        """A sentence for each damaged line."""
        read = enumerate(map(read_line, self.lines()), start=1)
        return [f"{self.file}:{n}: is no line: {why}" for n, why in read if isinstance(why, str)]


def write_table(lived: Iterable[Lived], file: Path) -> None:
    """Write the rows as a Parquet file."""
    pq.write_table(table_of(Lived, lived), file)


def read_table(file: Path) -> list[Lived]:
    """Read the rows of a file of `write_table`."""
    return [Lived(**row) for row in pq.read_table(file).to_pylist()]
