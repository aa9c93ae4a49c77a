"""Habits of the people in a home: which objects they take where, on which days, at what hours.

What happens on a day depends only on the file, the day and a seed. So a home that nobody looks at
for a week changes in the same way as one that is looked at every hour.
"""

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
)

from executive.errors import InputError
from executive.text import printable
from executive.toml_file import (
    in_words,
    packaged,
    parse_toml,
    read_toml,
    refuse_misread_bools,
    shown,
)
from sim.home.furniture import FORM_OF_KIND
from sim.home.home import Home

ANYWHERE = "anywhere"
"""Any searchable furniture of the home."""
DAYS = ("mon", "tue", "wed", "thu", "fri", "sat", "sun")
DAY_S = 86400.0
MOST_DAYS = 60
"""If more days have passed, only these last ones are simulated."""
_THURSDAY = 3
"""The weekday of 1970-01-01."""
_SHOWN = 80
_EXAMPLE = "see sim/habits/household.toml"


def _as_tuple(value: Any) -> Any:
    """A single text counts as a list of one."""
    return (value,) if isinstance(value, str) else value


def _weights(value: Any) -> Any:
    """Places without weights are equally likely."""
    named = _as_tuple(value)
    return dict.fromkeys(named, 1.0) if isinstance(named, list | tuple) else named


def _in_order(hours: tuple[float, float]) -> tuple[float, float]:
    if hours[0] >= hours[1]:
        raise ValueError("the first hour should be before the second one")
    return hours


Names = Annotated[tuple[str, ...], BeforeValidator(_as_tuple), Field(max_length=200)]
Hour = Annotated[float, Field(ge=0, le=24)]
Weight = Annotated[float, Field(gt=0, le=1e6)]


class Habit(BaseModel):
    """An action of a person with objects, at most once a day with each object."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    things: Names = ()
    """Names of objects; empty: all objects of the home."""
    to: Annotated[dict[str, Weight], BeforeValidator(_weights), Field(min_length=1, max_length=200)]
    """Pieces or kinds of furniture, or `anywhere`, with weights for the random choice."""
    only_from: Names = ()
    """Pieces or kinds of furniture that the object must be on; empty: any."""
    hours: Annotated[tuple[Hour, Hour], AfterValidator(_in_order)] = (0.0, 24.0)
    """It happens between these hours of the day (UTC)."""
    days: Annotated[
        tuple[Literal["mon", "tue", "wed", "thu", "fri", "sat", "sun"], ...],
        BeforeValidator(_as_tuple),
    ] = DAYS  # type: ignore[assignment]
    chance: Annotated[float, Field(ge=0, le=1)] = 1.0
    """The probability that it happens on such a day, for each object on its own."""


class Habits(BaseModel):
    """All habits in a file."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    habits: Annotated[tuple[Habit, ...], Field(min_length=1, max_length=200)]


@dataclass(frozen=True, slots=True)
class Move:
    """A person takes an object to other furniture, if it is on one of `only_from` (empty: any)."""

    time_s: float
    thing: str
    to: str
    only_from: tuple[str, ...]

    def fits(self, here: str) -> bool:
        """Whether the move applies to an object on the furniture `here` (empty: on none)."""
        wanted = here in self.only_from if self.only_from else bool(here)
        return wanted and here != self.to


def packaged_habits() -> tuple[str, ...]:
    """Names of the habits that come with the project."""
    return packaged("sim", "habits")


def load_habits(name_or_file: str, home: Home) -> Habits:
    """Read habits for a home, given the name of packaged ones or the path of a TOML file.

    Raises:
        InputError: if there are none of this name, if the file has a fault, or if it names objects
            or furniture that the home does not have.
    """
    where, tables = _read(name_or_file)
    try:
        habits = Habits.model_validate(tables)
    except ValidationError as error:
        raise _input_error(where, error) from None
    refuse_misread_bools(tables, habits, where)
    for number, habit in enumerate(habits.habits):
        _check_fits(home, habit, f"{where}: habits.{number}")
    return habits


def _read(name_or_file: str) -> tuple[str, dict[str, Any]]:
    known = f"packaged are {', '.join(packaged_habits())}; or give the path of a .toml file"
    if name_or_file.endswith(".toml"):
        return printable(name_or_file), read_toml(Path(name_or_file), known)
    if name_or_file not in packaged_habits():
        where = f"habits {printable(name_or_file)[:_SHOWN]}"
        raise InputError(where, "there are no habits of this name", known)
    file = files("sim").joinpath("habits", f"{name_or_file}.toml")
    return file.name, parse_toml(file.read_bytes(), file.name)


def _input_error(where: str, error: ValidationError) -> InputError:
    faults = error.errors(include_url=False)
    fault = next((one for one in faults if one["type"] == "extra_forbidden"), faults[0])
    key = printable(".".join(map(str, fault["loc"])))[:_SHOWN]
    if fault["type"] == "extra_forbidden":
        known = ", ".join((Habit if "." in key else Habits).model_fields)
        return InputError(where, f"there is no key {key}", f"known are {known}")
    if fault["type"] == "missing":
        return InputError(where, f"{key} is missing", _EXAMPLE)
    right = in_words(fault["msg"]).lower()
    return InputError(where, f"{key} is {shown(fault['input'])}", right)


def _check_fits(home: Home, habit: Habit, where: str) -> None:
    """Check that the home has the objects and furniture of a habit.

    Raises:
        InputError: names the first that is missing.
    """
    for name in habit.things:
        if name not in home.objects:
            what = f"there is no object {printable(name)[:_SHOWN]} in the home {home.name}"
            raise InputError(f"{where}.things", what, f"it has {', '.join(home.objects)}")
    for key, names in (("to", tuple(habit.to)), ("only_from", habit.only_from)):
        for name in names:
            if not (pieces_of(home, name) or name in FORM_OF_KIND):
                pieces = ", ".join(piece.name for piece in (*home.furniture, home.delivery))
                right = f"furniture: {pieces}; kinds: {', '.join(FORM_OF_KIND)}; or {ANYWHERE}"
                what = f"there is no furniture {printable(name)[:_SHOWN]}"
                raise InputError(f"{where}.{key}", what, right)


def pieces_of(home: Home, name: str) -> tuple[str, ...]:
    """The pieces of furniture that a name in a habit stands for: one, all of a kind, or all."""
    if name == ANYWHERE:
        return tuple(piece.name for piece in home.furniture)
    pieces = (*home.furniture, home.delivery)
    named = tuple(piece.name for piece in pieces if piece.name == name)
    return named or tuple(piece.name for piece in home.furniture if piece.kind == name)


def moves(habits: Habits, home: Home, since_s: float, until_s: float, seed: int) -> Iterator[Move]:
    """The moves after `since_s` until `until_s` (UTC, s), in order of time.

    If a habit names a kind of furniture, an object is always taken to the same piece of that kind,
    which the seed chooses. Habits are skipped if the home has no furniture for them.
    """
    first = max(int(since_s // DAY_S), int(until_s // DAY_S) - MOST_DAYS)
    for day in range(first, int(until_s // DAY_S) + 1):
        of_the_day = sorted(_of_day(habits, home, day, seed), key=lambda move: move.time_s)
        yield from (move for move in of_the_day if since_s < move.time_s <= until_s)


def _of_day(habits: Habits, home: Home, day: int, seed: int) -> Iterator[Move]:
    weekday = DAYS[(day + _THURSDAY) % len(DAYS)]
    for number, habit in enumerate(habits.habits):
        sources = tuple(piece for name in habit.only_from for piece in pieces_of(home, name))
        if not any(pieces_of(home, name) for name in habit.to):
            continue
        for thing in habit.things or tuple(home.objects):
            chance = random.Random(f"{seed} {day} {number} {thing}")
            happens, at, to = chance.random(), chance.uniform(*habit.hours), chance.random()
            if weekday in habit.days and happens < habit.chance:
                place = _chosen(home, habit, to, f"{seed} {number} {thing}", chance)
                if sources or not habit.only_from:
                    yield Move(day * DAY_S + at * 3600.0, thing, place, sources)


def _chosen(home: Home, habit: Habit, at: float, whose: str, chance: random.Random) -> str:
    """Choose a piece of furniture of this home by the habit's weights; `at` is in [0, 1)."""
    here = {name: weight for name, weight in habit.to.items() if pieces_of(home, name)}
    names, left = list(here), at * sum(here.values())
    for name in names:
        left -= here[name]
        if left < 0:
            break
    return _piece(pieces_of(home, name), name, whose, chance)


def _piece(pieces: Sequence[str], name: str, whose: str, chance: random.Random) -> str:
    if name == ANYWHERE:
        return chance.choice(pieces)
    return pieces[_usual(len(pieces), f"{whose} {name}")]


@cache
def _usual(count: int, whose: str) -> int:
    return random.Random(whose).randrange(count)
