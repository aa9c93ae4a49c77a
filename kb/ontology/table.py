"""The answer to a question in SPARQL."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Table:
    """An answer: entities are given by what they are called, values as they are."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str | int | float | bool, ...], ...]
