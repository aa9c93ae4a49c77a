"""The result of a SPARQL query."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Table:
    """A result; entities are given by name, literals by value."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str | int | float | bool, ...], ...]
