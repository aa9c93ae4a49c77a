"""Which recordings are meant by what was named on a command line."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from executive.errors import InputError
from logs.recording.reader import FILE_NAME

SUFFIXES = (".mcap", ".rrd")


class Chosen(NamedTuple):
    """A run's folder or its file, and which one of several it is; empty if there was no choice."""

    run: Path
    why: str = ""


def runs_in(folders: Iterable[Path]) -> Iterator[Path]:
    """Runs, and the runs in folders of runs."""
    for folder in folders:
        inside = sorted(found.parent for found in folder.glob(f"*/{FILE_NAME}"))
        yield from [folder] if (folder / FILE_NAME).exists() or not inside else inside


def newest(named: Sequence[Path]) -> Chosen:
    """The run that was written to last, of those named or in the folders named.

    Without a name it is the newest of the folder where `python -m executive` leaves its runs.

    Raises:
        InputError: if there is none. One that is named alone is taken as it is.
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
    """When; the names of runs begin with their time, which tells apart those copied together."""
    file = run / FILE_NAME if run.is_dir() else run
    return file.stat().st_mtime, run.name
