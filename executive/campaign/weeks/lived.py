"""What a week's campaign keeps: one JSON line for each command that was given to a household.

A line has what the mission came to, where all things were after it, and what was remembered in it.
So the lines of a household are all that it takes to go on from there.
"""

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from math import isfinite
from pathlib import Path
from typing import Any, get_type_hints

import pyarrow as pa
import pyarrow.parquet as pq

from executive.campaign.appending import append_line, cut_half_line
from executive.errors import InputError
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
    for name, kind in _KINDS.items():
        value = getattr(lived, name)
        if not isinstance(value, (int, float) if kind is float else kind):
            return f"{name} is {str(value)[:60]!r}"
    if not isfinite(time_s):
        return "time_s is no time"
    return Line(lived, time_s, things, facts)


class Diary:
    """The file with the lines; any number of processes on one machine may append."""

    def __init__(self, file: Path) -> None:
        """Use this file, which need not exist yet."""
        self._file = file

    def mend(self) -> None:
        """Cut off half a line that a power failure left.

        Raises:
            InputError: if the file cannot be written.
        """
        try:
            cut_half_line(self._file)
        except OSError as error:
            what = f"cannot be written: {error.strerror}"
            raise InputError(str(self._file), what, "choose another --out") from None

    def append(self, line: Line) -> None:
        """Add a line, on the disk when this returns; a full disk is waited for.

        Raises:
            InputError: if it cannot be written, and then nothing of it is there.
        """
        try:
            append_line(self._file, f"{line.to_json()}\n".encode())
        except OSError as error:
            what = f"cannot be written: {error.strerror}"
            right = "make room; the same command goes on from here"
            raise InputError(str(self._file), what, right) from None

    @property
    def size(self) -> int:
        """Bytes so far."""
        return self._file.stat().st_size if self._file.exists() else 0

    def entries(self) -> list[Line]:
        """One for each command that was given; of several the last counts. No damaged ones."""
        found = {}
        for text in self._texts():
            if isinstance(line := read_line(text), Line):
                one = line.lived
                found[one.household, one.day, one.turn] = line
        return [found[key] for key in sorted(found)]

    def damage(self) -> list[str]:
        """A sentence for each line that is none."""
        read = enumerate(map(read_line, self._texts()), start=1)
        return [f"{self._file}:{n}: is no line: {why}" for n, why in read if isinstance(why, str)]

    def _texts(self) -> Sequence[bytes]:
        return self._file.read_bytes().split(b"\n")[:-1] if self._file.exists() else []


def write_table(lived: Iterable[Lived], file: Path) -> None:
    """Write the rows as a Parquet file."""
    kinds = {str: pa.string(), bool: pa.bool_(), int: pa.int64(), float: pa.float64()}
    schema = pa.schema([(field.name, kinds[_KINDS[field.name]]) for field in fields(Lived)])
    pq.write_table(pa.Table.from_pylist([asdict(one) for one in lived], schema=schema), file)


def read_table(file: Path) -> list[Lived]:
    """The rows of a file of `write_table`."""
    return [Lived(**row) for row in pq.read_table(file).to_pylist()]
