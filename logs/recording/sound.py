"""Validates recorded values: what no mission records is refused when it is read."""

import json
from math import isfinite
from typing import Any

from pydantic import BaseModel

MOST = 2**63 - 1
"""Maximum of any count; tables cannot hold more."""
MOST_DEEP = 64
"""Maximum depth of a tree or a JSON value."""
LONGEST_S = 30 * 86_400.0
"""Maximum duration of a mission (s); a time farther from 0 is an error."""


class _There(BaseModel):
    """A place, with anything else that is known of it."""

    place: str


class _Asked(BaseModel):
    """A command."""

    kind: str | None = None


class _Known(BaseModel):
    """The parts of a situation that readers use, if present; the rest may be anything."""

    command: _Asked | None = None
    candidates: list[_There] | None = None
    candidate: _There | None = None
    found: _There | None = None
    visited: list[str] | None = None
    unreached: dict[str, str] | None = None
    among: list[str] | None = None


def check_situation(situation: dict[str, Any]) -> None:
    """Check the parts of a situation that readers use.

    Raises:
        ValueError: if one is invalid.
    """
    _Known.model_validate(situation)


def json_value(text: str) -> Any:
    """Parse a JSON value that is not nested too deeply for its readers.

    Raises:
        ValueError: if it is invalid, or nested too deeply.
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
    """Check a count: it must fit into every table.

    Raises:
        ValueError: if it does not.
    """
    if not 0 <= number <= MOST:
        raise ValueError(f"{number} is no number of things")
    return number


def finite(number: float) -> float:
    """Check a measured value: it must be finite.

    Raises:
        ValueError: if it is not.
    """
    if not isfinite(number):
        raise ValueError(f"{number} is no measure of anything")
    return number


def in_mission(time_s: float) -> float:
    """Check a mission time (s).

    Raises:
        ValueError: if no mission can have it.
    """
    if not isfinite(time_s) or abs(time_s) > LONGEST_S:
        raise ValueError(f"a time of {time_s:.6g} s is none of a mission")
    return time_s
