"""What a log line keeps of a dataclass: all its fields, as each declares it in its `metadata`."""

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any

NOT_LOGGED: Mapping[str, Any] = {"logged": False}
"""Marks a field that is not for the log."""
PART: Mapping[str, Any] = {"part": True}
"""Marks a field whose own fields stand in its place."""


def logged_as(
    key: str | None = None,
    plain: Callable[[Any], Any] | None = None,
    beside: Mapping[str, Callable[[Any], Any]] | None = None,
) -> Mapping[str, Any]:
    """Marks a field that the log keeps by another name, or made `plain` in its own way.

    `beside` are further keys for it, each with what it keeps.
    """
    return {"key": key, "plain": plain, "beside": beside or {}}


def snapshot(of: Any) -> dict[str, Any]:
    """The fields of a dataclass that are for the log, by their keys, as JSON can keep them."""
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
    """Of each field its name, its key, and what makes it plain; None for a part."""
    logged: list[tuple[str, str, Callable[[Any], Any] | None]] = []
    for field in fields(kind):
        marks = field.metadata
        if marks.get("logged", True):
            plain = None if marks.get("part") else marks.get("plain") or _plain
            logged.append((field.name, marks.get("key") or field.name, plain))
            logged += [(field.name, key, kept) for key, kept in marks.get("beside", {}).items()]
    return tuple(logged)


_ATOMS = frozenset((str, int, float, bool, type(None)))
"""What most values are; asked first, because this runs for each field at each tick."""


def _plain(value: Any) -> Any:
    """The value made of lists, dictionaries and what they can hold; strange things as they are."""
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
    """Of the fields, if it is a dataclass; none otherwise."""
    return tuple(field.name for field in fields(kind)) if is_dataclass(kind) else ()
