"""Reads home files, and lists all faults in one."""

from functools import cache, lru_cache
from importlib.resources import files
from itertools import islice
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from executive.errors import InputError
from executive.files import decoded, read_bytes
from executive.toml_file import MOST_BYTES, in_words, packaged, parse_toml, shown
from sim.home.floorplan import FARTHEST_M
from sim.home.home import Home
from sim.home.naming import usable
from sim.home.own import is_declaration
from sim.home.validation import home_flaws, mesh_flaws

MOST_TOLD = 100
"""The most faults that are reported for one file."""
_SHOWN = 80
"""The most characters of a wrong value in a message."""


def load_home(name_or_path: str) -> Home:
    """Read a home, given the name of a packaged one or the path of a TOML file.

    Raises:
        InputError: if there is no such home, or it has a fault; the message names file and key.
    """
    if name_or_path in packaged_homes():
        return _packaged(name_or_path)
    return _sound(*_read(name_or_path))


@cache
def _packaged(name: str) -> Home:
    """Read a packaged home; its file does not change while we run."""
    return _sound(*_read(name))


@lru_cache(maxsize=8)
def _sound(content: bytes, where: str) -> Home:
    """The home of a file's content, cached; raises its first fault."""
    home, faults = _inspect(content, where, Path(where).parent)
    if home is None or faults:
        raise faults[0]
    return home


def inspect_home(name_or_path: str) -> tuple[Home | None, tuple[InputError, ...]]:
    """Read a home, and list all faults in its file; no home if keys or values are invalid.

    Raises:
        InputError: if there is no such home, or the file is not TOML.
    """
    content, where = _read(name_or_path)
    return _inspect(content, where, Path(where).parent)


def recorded_home(content: bytes) -> Home:
    """The home of a recording; its meshes are not read, as they may be gone.

    Raises:
        InputError: if the file has a fault.
    """
    home, faults = _inspect(content, "home.toml", None)
    if home is None or faults:
        raise faults[0]
    return home


def _inspect(
    content: bytes, where: str, folder: Path | None
) -> tuple[Home | None, tuple[InputError, ...]]:
    data = {"name": usable(Path(where).stem), **parse_toml(content, where)}
    try:
        home = Home.from_file(data, where, folder)
    except ValidationError as error:
        faults = error.errors(include_url=False)
        around = {fault["loc"][:depth] for fault in faults for depth in range(len(fault["loc"]))}
        found = islice((fault for fault in faults if fault["loc"] not in around), MOST_TOLD)
        return None, tuple(_input_error(where, data, fault) for fault in found)
    flaws = list(islice(home_flaws(home), MOST_TOLD)) or list(islice(mesh_flaws(home), MOST_TOLD))
    return home, tuple(InputError(where, *flaw) for flaw in flaws)


def home_text(name_or_path: str) -> str:
    """The text of a home's file, as `load_home` reads it.

    Raises:
        InputError: if there is no such home.
    """
    return decoded(*_read(name_or_path))


def packaged_homes() -> tuple[str, ...]:
    """Names of the homes that come with the project."""
    return packaged("sim", "homes")


def _read(name_or_path: str) -> tuple[bytes, str]:
    """The content of a home's file, and its name for messages."""
    known = f"packaged are {', '.join(packaged_homes())}"
    if name_or_path.endswith(".toml"):
        return read_bytes(Path(name_or_path), MOST_BYTES, right=known), name_or_path
    if name_or_path in packaged_homes():
        file = files("sim").joinpath("homes", f"{name_or_path}.toml")
        return file.read_bytes(), file.name
    known += "; or give the path of a .toml file"
    raise InputError(f"home {name_or_path[:_SHOWN]}", "there is no home of this name", known)


def _input_error(where: str, data: Any, fault: ErrorDetails) -> InputError:
    """The InputError for an error of pydantic, with the key as in the file."""
    key = _key(data, fault["loc"])
    example = "see sim/homes/four_rooms.toml"
    match fault["loc"]:
        case ("objects", name, _, *_) if is_declaration(data["objects"][name]):
            example = "see docs/own-home.md"
    if fault["type"] == "extra_forbidden":
        return InputError(where, f"there is no key {key}", example)
    if fault["type"] == "missing":
        return InputError(where, f"{key} is missing", example)
    return InputError(where, f"{key} is {shown(fault['input'])}", _right(fault))


def _key(data: Any, path: tuple[str | int, ...]) -> str:
    """A path into the file for a message, with names for numbers: `furniture.desk.size.0`."""
    words = []
    for part in path:
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            data = None
        name = data.get("name") if isinstance(part, int) and isinstance(data, dict) else None
        words.append(str(part if name is None else name)[:_SHOWN])
    return ".".join(words)


def _right(fault: ErrorDetails) -> str:
    said = in_words(fault["msg"].lower())
    is_point = any(bound in (-FARTHEST_M, FARTHEST_M) for bound in fault.get("ctx", {}).values())
    return f"{said} (metres)" if is_point else said
