"""What a week's campaign keeps: one JSON line for each command that was given to a household.

A line has what the mission came to, where all things were after it, and what was remembered in it.
So the lines of a household are all that it takes to go on from there.
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
    """How one command in the life of a household went; times in seconds."""

    policy: str
    home: str
    llm: str
    seed: int
    day: int
    """From 0."""
    turn: int
    """Of the day, from 0."""
    hour: float
    """Of the day, at which the command was given."""
    command: str
    object: str = ""
    status: str = ""
    reason: str = ""
    completed: bool = False
    """Done by the world's truth."""
    source: str = ""
    """Who named the place where it was found."""
    location: str = ""
    inquiries: int = 0
    visits: int = 0
    visited: str = ""
    stale: int = 0
    """1 if the robot looked in vain where its memory had the thing, rather than not."""
    misguided: int = 0
    """1 if it looked in vain where it took people to have brought it, rather than not."""
    search_s: float = 0.0
    cost_s: float = 0.0
    mission_time_s: float = 0.0
    wall_time_s: float = 0.0

    @property
    def household(self) -> tuple[str, str, str, int]:
        """Whose it was."""
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
        time_s: when the mission had ended, by the home's clock (UTC).
        things: where each thing was then.
        facts: what was remembered in it.
    """

    lived: Lived
    time_s: float
    things: dict[str, str]
    facts: tuple[Fact, ...]

    def to_json(self) -> str:
        """As the journal has it."""
        facts = [[str(f.kind), f.object, f.place, f.time_s] for f in self.facts]
        kept = {"time_s": self.time_s, "things": self.things, "facts": facts}
        return json.dumps({**asdict(self.lived), **kept})


def read_line(text: bytes) -> Line | str:
    """A line of the journal, or why it is none."""
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
        """Add one, as `LineFile.write` does."""
        self.write(line.to_json())

    def entries(self) -> list[Line]:
        """One for each command that was given; of several the last counts. No damaged ones."""
        found = {}
        for text in self.lines():
            if isinstance(line := read_line(text), Line):
                one = line.lived
                found[one.household, one.day, one.turn] = line
        return [found[key] for key in sorted(found)]

    def damage(self) -> list[str]:
        """A sentence for each line that is none."""
        read = enumerate(map(read_line, self.lines()), start=1)
        return [f"{self.file}:{n}: is no line: {why}" for n, why in read if isinstance(why, str)]


def write_table(lived: Iterable[Lived], file: Path) -> None:
    """Write the rows as a Parquet file."""
    pq.write_table(table_of(Lived, lived), file)


def read_table(file: Path) -> list[Lived]:
    """The rows of a file of `write_table`."""
    return [Lived(**row) for row in pq.read_table(file).to_pylist()]
