"""Turns a dataclass into JSON for a log line, as its fields declare in their `metadata`."""

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any

NOT_LOGGED: Mapping[str, Any] = {"logged": False}
"""Metadata of a field that the log leaves out."""
PART: Mapping[str, Any] = {"part": True}
"""Metadata of a field whose own fields are put in its place."""


def logged_as(
    key: str | None = None,
    plain: Callable[[Any], Any] | None = None,
    beside: Mapping[str, Callable[[Any], Any]] | None = None,
) -> Mapping[str, Any]:
    """Metadata of a field that the log keeps under another key, or converts in its own way.

    Args:
        key: the key in the log; None: the field's name.
        plain: converts the value to what JSON can keep.
        beside: further keys, each with the function that computes its value from the field.
    """
    return {"key": key, "plain": plain, "beside": beside or {}}


def snapshot(of: Any) -> dict[str, Any]:
    """The logged fields of a dataclass by their keys, as values that JSON can keep."""
    known: dict[str, Any] = {}
    for name, key, plain in _logged(of.__class__):
        value = getattr(of, name)
        if plain is None:
            known |= snapshot(value)
        else:
            known[key] = plain(value)
    return known


@cache
def _logged(kind: type) -> tuple[tuple[str, str, Callable[[Any], Any] | None], ...]:
    """Name, key and converter of each logged field; the converter of a part is None."""
    logged: list[tuple[str, str, Callable[[Any], Any] | None]] = []
    for field in fields(kind):
        marks = field.metadata
        if marks.get("logged", True):
            plain = None if marks.get("part") else marks.get("plain") or _plain
            logged.append((field.name, marks.get("key") or field.name, plain))
            logged += [(field.name, key, kept) for key, kept in marks.get("beside", {}).items()]
    return tuple(logged)


_ATOMS = frozenset((str, int, float, bool, type(None)))
"""The types of most values; checked first, because this runs for each field at each tick."""


def _plain(value: Any) -> Any:
    """The value as lists, dictionaries and atoms; values of other types stay as they are."""
    kind = value.__class__
    if kind in _ATOMS:
        return value
    if kind is list or kind is tuple:
        return [_plain(item) for item in value]
    if kind is dict:
        return {name: _plain(item) for name, item in value.items()}
    if names := _names(kind):
        return {name: _plain(getattr(value, name)) for name in names}
    return value


@cache
def _names(kind: Any) -> tuple[str, ...]:
    """Names of the fields if it is a dataclass; else empty."""
    return tuple(field.name for field in fields(kind)) if is_dataclass(kind) else ()
