"""Messages whose fields have the names and types of their record's fields."""

from collections.abc import Callable
from typing import Any, TypeVar, get_type_hints

from logs.recording.schema import STAMPED, Definitions
from logs.recording.sound import finite

R = TypeVar("R")

_KINDS: dict[Any, str] = {
    str: "string",
    bool: "bool",
    int: "int64",
    float: "double",
    tuple[str, ...]: "repeated string",
    tuple[bool, ...]: "repeated bool",
    tuple[int, ...]: "repeated int64",
    tuple[float, ...]: "repeated double",
}


def definition(record: type, name: str) -> Definitions:
    """The message definition of a record with text, numbers, booleans, and tuples of these.

    Raises:
        TypeError: if a field has another type.
    """
    fields = get_type_hints(record)
    for field, kind in fields.items():
        if kind not in _KINDS:
            what = f"{record.__name__}.{field} is {kind}, and no text, number, yes or no, or tuple"
            raise TypeError(f"{what} of such: define its message in logs/recording/schema.py")
    return {name: {**STAMPED, **{field: _KINDS[kind] for field, kind in fields.items()}}}


def to_fields(record: type[R]) -> Callable[[R], dict[str, Any]]:
    """A function that makes the fields of a message from such a record."""
    names = tuple(get_type_hints(record))
    return lambda told: {name: getattr(told, name) for name in names}


def from_message(record: type[R]) -> Callable[[Any], R]:
    """A function that makes such a record from a message; ValueError if a number is not finite."""
    names = tuple(get_type_hints(record))
    return lambda message: record(*[_value(getattr(message, name)) for name in names])


def _value(value: Any) -> Any:
    match value:
        case float():
            return finite(value)
        case str() | int():
            return value
        case _:
            return tuple(_value(part) for part in value)
