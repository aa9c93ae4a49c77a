"""ROS 2 messages as rclpy has them, to plain tables and back."""

import array
import re
from collections.abc import Mapping
from importlib import import_module
from typing import Any

import numpy as np

from executive.ros.link import LinkError
from executive.ros.protocol import Message

_ELEMENT = re.compile(r"(?:sequence<)?(?P<kind>\w+/\w+)(?:, \d+>|>|\[\d+\])?$")


def type_named(name: str) -> Any:
    """The class of `PACKAGE/msg/NAME`, `PACKAGE/srv/NAME` or `PACKAGE/action/NAME`.

    Raises:
        LinkError: if this machine does not have it.
    """
    package, kind, last = name.split("/")
    try:
        return getattr(import_module(f"{package}.{kind}"), last)
    except (ImportError, AttributeError):
        raise LinkError(f"this machine does not know the type {name}: install {package}") from None


def to_table(message: Any) -> Message:
    """The fields of a message."""
    names = message.get_fields_and_field_types()
    return {name: _plain(getattr(message, name)) for name in names}


def _plain(value: Any) -> Any:
    if hasattr(value, "get_fields_and_field_types"):
        return to_table(value)
    if isinstance(value, array.array):
        return value.tobytes() if value.typecode == "B" else np.array(value)
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    return value


def fill(message: Any, table: Mapping[str, Any]) -> Any:
    """Put the values of a table into a message; what it does not have stays as it is.

    Raises:
        LinkError: if the message has no such field, or of another kind.
    """
    kinds = message.get_fields_and_field_types()
    for name, value in table.items():
        if name not in kinds:
            raise LinkError(f"{type(message).__name__} has no field {name}")
        try:
            setattr(message, name, _filled(getattr(message, name), kinds[name], value))
        except (AssertionError, AttributeError, TypeError) as error:
            raise LinkError(f"{type(message).__name__}.{name}: {error}"[:200]) from None
    return message


def _filled(now: Any, kind: str, value: Any) -> Any:
    if isinstance(value, Mapping):
        return fill(now, value)
    if isinstance(value, bytes):
        return array.array("B", value)
    if isinstance(value, list) and (element := _ELEMENT.match(kind)):
        package, last = element["kind"].split("/")
        made = type_named(f"{package}/msg/{last}")
        return [fill(made(), one) for one in value]
    return value
