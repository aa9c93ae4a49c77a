"""Finds the recordings that are meant on a command line."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from executive.errors import InputError
from logs.recording.reader import FILE_NAME

SUFFIXES = (".mcap", ".rrd")


class Chosen(NamedTuple):
    """A run's folder or file, and why it was chosen; empty if the names mean only this one."""

    run: Path
    why: str = ""


def runs_in(folders: Iterable[Path]) -> Iterator[Path]:
    """The given runs, and those in given folders; a folder without runs is yielded as it is."""
    for folder in folders:
        inside = sorted(found.parent for found in folder.glob(f"*/{FILE_NAME}"))
        yield from [folder] if (folder / FILE_NAME).exists() or not inside else inside


def newest(named: Sequence[Path]) -> Chosen:
    """The run that was written last, among the given runs and folders.

    Without a name, the newest run in the folder where `python -m executive` creates them.

    Raises:
        InputError: if there is none. A single named run is accepted without a check.
    """
    folders = named or [_folder_of_runs()]
    found = list(runs_in(folders))
    if named and len(found) == 1:
        return Chosen(found[0])
    runs = [run for run in found if _is_recording(run)]
    if not runs:
        where = ", ".join(map(str, folders))
        raise InputError(where, "there is no run", "name a run's folder")
    why = f"the newest of {len(runs)}" if len(runs) > 1 else "the only run"
    return Chosen(max(runs, key=_written), why)


def _folder_of_runs() -> Path:
    from executive.config import load_settings  # takes a tenth of a second

    return load_settings().runs


def _is_recording(run: Path) -> bool:
    return (run / FILE_NAME).is_file() or (run.suffix in SUFFIXES and run.is_file())


def _written(run: Path) -> tuple[float, str]:
    """The time and the name; names of runs begin with a time, which orders runs copied together."""
    file = run / FILE_NAME if run.is_dir() else run
    return file.stat().st_mtime, run.name
