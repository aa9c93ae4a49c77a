"""Command-line options, generated from the fields of `Settings`."""

import argparse
import types
from collections.abc import Iterator
from enum import Enum
from typing import Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from executive.config import Option, Settings


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Add the options of all settings that have one, in order."""
    for name in _in_order():
        add_setting(parser, name)


def add_setting(parser: argparse.ArgumentParser, name: str, **otherwise: Any) -> None:
    """Add the option of one setting; `otherwise` overrides arguments of `add_argument`."""
    field = Settings.model_fields[name]
    said = {"help": _help(field), **_kind(field), **otherwise}
    parser.add_argument(f"--{name.replace('_', '-')}", **said)


def _in_order() -> list[str]:
    """The settings with an option, in the order for `--help`; see `Option.after`."""
    names: list[str] = []
    for name, field in Settings.model_fields.items():
        option = option_of(field)
        if option:
            at = names.index(option.after) + 1 if option.after else len(names)
            names.insert(at, name)
    return names


def option_of(field: FieldInfo) -> Option | None:
    """The `Option` of a field; None if it has none."""
    return next((one for one in field.metadata if isinstance(one, Option)), None)


def _help(field: FieldInfo) -> str:
    option = option_of(field)
    if option and option.help:
        return option.help
    default = "" if field.default in (None, ()) else f" (default: {field.default})"
    return f"{field.description}{default}"


def _kind(field: FieldInfo) -> dict[str, Any]:
    """The arguments of `add_argument` that follow from the field's type."""
    option = option_of(field)
    metavar = {"metavar": option.metavar} if option and option.metavar else {}
    kind = _of_set_value(field.annotation)
    if kind is bool:
        return {"action": argparse.BooleanOptionalAction}
    if get_origin(kind) is dict:
        return {"action": _Pairs, **metavar}
    if get_origin(kind) is tuple:
        return {"action": "append", "type": get_args(kind)[0], **metavar}
    if choices := list(_choices(kind)):
        return {"choices": choices}
    return {"type": kind, **metavar}


def _of_set_value(annotation: Any) -> Any:
    """The type without None: int for `int | None`."""
    if get_origin(annotation) in (Union, types.UnionType):
        return next(kind for kind in get_args(annotation) if kind is not type(None))
    return annotation


def _choices(kind: Any) -> Iterator[str]:
    if get_origin(kind) is Literal:
        yield from get_args(kind)
    elif isinstance(kind, type) and issubclass(kind, Enum):
        yield from (str(one) for one in kind)


class _Pairs(argparse.Action):
    """Collects OBJECT=FURNITURE pairs."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Add one pair."""
        name, equals, value = values.partition("=")
        if not (name and equals and value):
            parser.error(f"{option_string} {values}: should be {self.metavar}, as in mug=desk")
        pairs = getattr(namespace, self.dest) or {}
        if pairs.get(name, value) != value:
            parser.error(f"{option_string} {values}: it is {name}={pairs[name]}, too; give one")
        setattr(namespace, self.dest, {**pairs, name: value})
