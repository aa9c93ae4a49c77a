"""A folder that one process has to itself, as long as it lives."""

import fcntl
import os
from pathlib import Path
from typing import TextIO

from executive.errors import InputError

LOCK = "lock"
"""Name of the file that is locked; it stays, but the lock ends with its process."""
_FLAGS = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_NONBLOCK
"""To open it: a named pipe there, which nobody may read, is an error and not waited for."""


def lock_folder(
    folder: Path,
    option: str,
    taken: str = "another campaign is running in it",
    right: str = "wait until it has ended, or name another folder",
) -> TextIO:
    """Have the folder until the file that is returned is closed, or this process ends.

    That somebody else has it is told as `taken`, with what would be `right` then.

    Raises:
        InputError: if another process has it, or it cannot be written to.
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
