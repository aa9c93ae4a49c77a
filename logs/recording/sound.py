"""What a recorded value may be: what no mission records is refused where it is read."""

import json
from math import isfinite
from typing import Any

from pydantic import BaseModel

MOST = 2**63 - 1
"""Of anything that is counted: no table holds more."""
MOST_DEEP = 64
"""Levels of a tree, or of a JSON value."""
LONGEST_S = 30 * 86_400.0
"""No mission takes longer: a time beyond it is wrong."""


class _There(BaseModel):
    """A place, and who says so."""

    place: str


class _Asked(BaseModel):
    """A command."""

    kind: str | None = None


class _Known(BaseModel):
    """What readers look for in a situation, if it is there; the rest may be anything."""

    command: _Asked | None = None
    candidates: list[_There] | None = None
    candidate: _There | None = None
    found: _There | None = None
    visited: list[str] | None = None
    unreached: dict[str, str] | None = None
    among: list[str] | None = None


def check_situation(situation: dict[str, Any]) -> None:
    """See that readers find what they look for as it should be.

    Raises:
        ValueError: if not.
    """
    _Known.model_validate(situation)


def json_value(text: str) -> Any:
    """A JSON value that is not nested too deeply for whatever reads it.

    Raises:
        ValueError: if it is none.
        RecursionError: if it is nested very deeply.
    """
    value = json.loads(text)
    level = [value]
    for _ in range(MOST_DEEP):
        level = [inner for outer in level if isinstance(outer, list | dict) for inner in _in(outer)]
        if not level:
            return value
    raise ValueError(f"a value is nested more than {MOST_DEEP} times")


def _in(outer: list[Any] | dict[str, Any]) -> Any:
    return outer.values() if isinstance(outer, dict) else outer


def whole(number: int) -> int:
    """A number of things, as every table can hold it.

    Raises:
        ValueError: if it is none.
    """
    if not 0 <= number <= MOST:
        raise ValueError(f"{number} is no number of things")
    return number


def finite(number: float) -> float:
    """A measure of something.

    Raises:
        ValueError: if it is none.
    """
    if not isfinite(number):
        raise ValueError(f"{number} is no measure of anything")
    return number


def in_mission(time_s: float) -> float:
    """A mission time (s), which must be one.

    Raises:
        ValueError: if no mission has it.
    """
    if not isfinite(time_s) or abs(time_s) > LONGEST_S:
        raise ValueError(f"a time of {time_s:.6g} s is none of a mission")
    return time_s
