"""Safe reading of TOML files from outside.

Large files, deep nesting and numbers of more than 64 bits are refused: they would be slow to read,
or could not be written to a log.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from datetime import date, time
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

from executive.errors import InputError
from executive.files import decoded, read_bytes

MOST_BYTES = 2**20
"""The largest file: a home with 5,000 pieces of furniture, read in 2 s at most."""
DEEPEST = 16
"""The largest depth of nested tables and arrays."""
_STRING_OR_COMMENT = re.compile(
    r'"""(?:\\.|[^\\])*?(?:"""|\Z)|"(?:\\.|[^"\\\n])*+"?'
    r"|'''.*?(?:'''|\Z)|'[^'\n]*+'?|#[^\n]*+",
    re.DOTALL,
)
_LONG_KEY = re.compile(rf"(?:\.[ \t]*+[\w-]++[ \t]*+){{{DEEPEST},}}")
"""`a.a.a. ...`: parsing takes time quadratic in the parts of such a key."""
_LONG_NUMBER = re.compile(r"\d[\d_]{639,}")
"""Python may refuse an integer with so many digits, and does not say which one it is."""
_SHOWN = 60
"""Messages show this many characters of a wrong key."""
_MOST_SHOWN = 80
"""Likewise of a value."""
_PYTHONS = re.compile(
    r"\btuple\b|\bdictionary( or instance of \w+)?\b| after validation|Value error, ", re.IGNORECASE
)
_BOOL = "should be true or false"
_TOMLS = {"tuple": "list", " after validation": "", "value error, ": ""}


def read_toml(path: Path, right: str = "") -> dict[str, Any]:
    """The tables of a TOML file.

    Args:
        path: the file.
        right: what to give instead of a file that cannot be read.

    Raises:
        InputError: if it cannot be read, is not TOML, or has values that are not allowed.
    """
    return parse_toml(read_bytes(path, MOST_BYTES, right=right), str(path))


def parse_toml(content: bytes, where: str) -> dict[str, Any]:
    """The tables in the content of a TOML file; `where` names it in messages.

    Raises:
        InputError: as `read_toml`.
    """
    if len(content) > MOST_BYTES:
        raise InputError(where, f"is larger than {MOST_BYTES >> 20} MB", "give a smaller file")
    text = decoded(content, where)
    if _LONG_KEY.search(_STRING_OR_COMMENT.sub("s", text)):
        raise _too_deep(where)
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(where, f"is not TOML: {error}") from None
    except RecursionError:
        raise _too_deep(where) from None
    except ValueError:  # Python refuses a number with thousands of digits
        number = max(_LONG_NUMBER.finditer(text), key=lambda found: len(found[0]))
        line = text.count("\n", 0, number.start()) + 1
        raise InputError(where, f"line {line} has a number of more than 64 bits") from None
    _check(tables, where)
    return tables


def packaged(package: str, folder: str) -> tuple[str, ...]:
    """Names of the TOML files in a folder of one of our packages."""
    entries = files(package).joinpath(folder).iterdir()
    return tuple(sorted(e.name.removesuffix(".toml") for e in entries if e.name.endswith(".toml")))


def in_words(said: str) -> str:
    """A message of pydantic with TOML's names of types."""
    return _PYTHONS.sub(lambda found: _TOMLS.get(found[0].lower(), "table"), said)


def shown(value: object) -> str:
    """A value, or its beginning, for messages: `true`, `5`, `'desk'`."""
    text = str(value).lower() if isinstance(value, bool) else repr(value)
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."


class Misread(NamedTuple):
    """A value that pydantic converted to another type: `true` to 1, `"5"` to 5.

    Attributes:
        path: keys and, in lists, indices.
        value: the value in the file.
        right: what it should be.
    """

    path: tuple[str | int, ...]
    value: bool | int | float | str
    right: str

    @property
    def key(self) -> str:
        """The path, for messages."""
        return ".".join(map(str, self.path))[:_SHOWN]

    @property
    def shown(self) -> str:
        """The value, for messages."""
        return shown(self.value)


def misread(tables: Mapping[str, Any], read: object) -> Iterator[Misread]:
    """Find the values that pydantic converted to another type.

    Args:
        tables: the tables of the file.
        read: the model that was made from them; its fields have the names of the keys.
    """
    left: list[tuple[tuple[str | int, ...], Any, Any]] = [((), tables, read)]
    while left:
        path, said, made = left.pop()
        if isinstance(said, dict):
            left += [((*path, key), one, _part(made, key)) for key, one in said.items()]
        elif isinstance(said, list):
            left += [((*path, n), one, _item(made, n)) for n, one in enumerate(said)]
        elif isinstance(said, bool | int | float | str) and (right := _other_kind(said, made)):
            yield Misread(path, said, right)


def refuse_misread_bools(tables: Mapping[str, Any], read: object, where: str) -> None:
    """Refuse a bool that was read as a number, and any other value that was read as a bool.

    Raises:
        InputError: if there is one.
    """
    for one in misread(tables, read):
        if isinstance(one.value, bool) or one.right == _BOOL:
            raise InputError(where, f"{one.key} is {one.shown}", one.right)


def _part(made: object, key: str) -> object:
    return made.get(key) if isinstance(made, dict) else getattr(made, key, None)


def _item(made: object, number: int) -> object:
    """The item of a list; a point or a pose, which is made from a list, has only numbers."""
    if isinstance(made, list | tuple):
        return made[number] if number < len(made) else None
    return None if made is None else 0.0


def _other_kind(said: bool | float | str, made: object) -> str:
    """What the value should be; empty if it already has the type of `made`."""
    if isinstance(made, bool):
        return "" if isinstance(said, bool) else _BOOL
    is_number = isinstance(made, int | float)
    if is_number and isinstance(said, bool):
        return "should be a number"
    return "should be a number, without quotes" if is_number and isinstance(said, str) else ""


def _check(tables: dict[str, Any], where: str) -> None:
    """Refuse values that are not allowed; without recursion, as the nesting may be deep."""
    left: list[tuple[str, Any, int]] = [("", tables, 0)]
    while left:
        key, value, depth = left.pop()
        if depth > DEEPEST:
            raise _too_deep(where)
        if isinstance(value, dict):
            left += [(f"{key}.{name}".lstrip("."), one, depth + 1) for name, one in value.items()]
        elif isinstance(value, list):
            left += [(f"{key}.{number}", one, depth + 1) for number, one in enumerate(value)]
        elif isinstance(value, int) and not -(2**63) <= value < 2**63:
            raise InputError(where, f"{key[:_SHOWN]} is a number of more than 64 bits")
        elif isinstance(value, date | time):
            right = "put words into quotes"
            raise InputError(where, f"{key[:_SHOWN]} is a date or a time", right)


def _too_deep(where: str) -> InputError:
    return InputError(where, f"is nested deeper than {DEEPEST} tables and arrays", "flatten it")
