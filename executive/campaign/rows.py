"""Tables of dataclasses: validation of values, and conversion to Arrow."""

from collections.abc import Iterable
from dataclasses import asdict
from math import isfinite
from typing import Any, get_type_hints

import pyarrow as pa

from executive.text import writable

_COLUMNS: dict[object, pa.DataType] = {
    str: pa.string(),
    bool: pa.bool_(),
    int: pa.int64(),
    float: pa.float64(),
    str | None: pa.string(),
    int | None: pa.int64(),
    tuple[str, ...]: pa.list_(pa.string()),
}


def misfit(row: Any, kinds: dict[str, type]) -> str:
    """Which value of a row does not fit its column, in words; empty if all fit.

    Args:
        row: a dataclass's instance.
        kinds: types of its fields: `str`, `bool`, `int` or `float`.
    """
    values = ((name, getattr(row, name), kind) for name, kind in kinds.items())
    wrong = ((name, value) for name, value, kind in values if not _fits(value, kind))
    return next((f"{name} is {str(value)[:60]!r}" for name, value in wrong), "")


def table_of(kind: type, rows: Iterable[Any]) -> pa.Table:
    """A table with a column for each field of the dataclass, also without rows."""
    schema = pa.schema([(name, _COLUMNS[hint]) for name, hint in get_type_hints(kind).items()])
    return pa.Table.from_pylist([asdict(row) for row in rows], schema=schema)


def _fits(value: object, kind: type) -> bool:
    """Whether a table can hold the value: valid UTF-8, numbers of 64 bits."""
    match value:
        case str():
            return kind is str and writable(value) == value
        case bool():
            return kind is bool
        case int():
            return kind in (int, float) and -(2**63) <= value < 2**63
        case float():
            return kind is float and isfinite(value)
    return False
