"""Locks a folder for one process, until it ends."""

import fcntl
import os
from pathlib import Path
from typing import TextIO

from executive.errors import InputError

LOCK = "lock"
"""Name of the lock file; the file stays, but the lock ends with the process."""
_FLAGS = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_NONBLOCK
"""Flags to open it; with O_NONBLOCK, a named pipe without a reader is an error, not a wait."""


def lock_folder(
    folder: Path,
    option: str,
    taken: str = "another campaign is running in it",
    right: str = "wait until it has ended, or name another folder",
) -> TextIO:
    """Lock a folder until the returned file is closed, or this process ends.

    If another process has the lock, the error says `taken`, and `right` as what to do.

    Raises:
        InputError: if another process has the lock, or the folder cannot be written to.
    """
    try:
        stream = os.fdopen(os.open(folder / LOCK, _FLAGS, 0o666), "a", encoding="utf-8")
    except OSError as error:
        what, use = f"cannot use it: {error.strerror}", "name a folder to write to"
        raise InputError(f"{option} {folder}", what, use) from None
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        stream.close()
        raise InputError(f"{option} {folder}", taken, right) from None
    except OSError as error:
        stream.close()
        what, use = f"cannot lock it: {error.strerror}", "name a folder on a disk of this machine"
        raise InputError(f"{option} {folder}", what, use) from None
    return stream
