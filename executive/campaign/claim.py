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
    folder: Path, option: str, taken: str = "another campaign is running in it"
) -> TextIO:
    """Have the folder until the file that is returned is closed, or this process ends.

    That somebody else has it is told as `taken`.

    Raises:
        InputError: if another process has it, or it cannot be written to.
    """
    try:
        stream = os.fdopen(os.open(folder / LOCK, _FLAGS, 0o666), "a", encoding="utf-8")
    except OSError as error:
        right = "name a folder to write to"
        raise InputError(f"{option} {folder}", f"cannot use it: {error.strerror}", right) from None
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        stream.close()
        right = "wait until it has ended, or name another folder"
        raise InputError(f"{option} {folder}", taken, right) from None
    except OSError as error:
        stream.close()
        right = "name a folder on a disk of this machine"
        raise InputError(f"{option} {folder}", f"cannot lock it: {error.strerror}", right) from None
    return stream
