"""The folder with the files of one mission."""

import json
import logging
import re
from contextlib import suppress
from dataclasses import asdict
from datetime import datetime
from itertools import count
from pathlib import Path

from executive.errors import InputError
from executive.text import printable
from executive.types.outcome import Outcome

log = logging.getLogger(__name__)

SLUG_LENGTH = 40
LONGEST_WORDS = 1000


def new_folder(runs: Path, started: datetime, words: str) -> Path:
    """Make `runs/<UTC>-<slug>/`, with a number if it exists.

    Raises:
        InputError: if the folder cannot be made.
    """
    slug = (
        re.sub(r"[^a-z0-9]+", "-", words[:LONGEST_WORDS].lower())
        .strip("-")[:SLUG_LENGTH]
        .strip("-")
    )
    name = f"{started:%Y%m%dT%H%M%SZ}-{slug or 'nothing'}"
    for number in count(1):
        folder = runs / (name if number == 1 else f"{name}-{number}")
        try:
            folder.mkdir(parents=True)
            return folder
        except FileExistsError:
            if not runs.is_dir():
                raise InputError("--runs", f"{runs} is not a folder") from None
        except (OSError, ValueError) as error:
            why = error.strerror if isinstance(error, OSError) else "it is no name of a folder"
            right = "name a folder to write to"
            raise InputError("--runs", f"cannot make {folder}: {why}", right) from None
    raise AssertionError("unreachable")


def write(file: Path, text: str) -> bool:
    """Write a file of the run atomically; return whether that worked.

    It only warns if not, because a full disk must not end the mission.
    """
    new = file.with_name(f"{file.name}.new")
    try:
        new.write_text(text, encoding="utf-8", errors="backslashreplace")
        new.replace(file)
    except OSError as error:
        log.warning("cannot write %s: %s", printable(file), error.strerror)
        with suppress(OSError):
            new.unlink()
        return False
    return True


def to_json(outcome: Outcome) -> str:
    """The outcome as JSON on one line."""
    return json.dumps(asdict(outcome))
