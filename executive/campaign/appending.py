"""Appends lines to a file from several processes of one machine, each line whole and on the disk.

A line that a full disk cuts short is completed when there is room again; one that a killed process
left incomplete is removed by the next writer. Writers hold a file lock, which the system releases
when a process ends.
"""

import errno
import fcntl
import os
import stat
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from executive.errors import InputError

PATIENCE_S = 60.0
"""How long (s) to wait for room on a full disk."""
_POLL_S = 0.2
_FULL = {errno.ENOSPC, errno.EDQUOT}
_TAIL = 1 << 16


def append_line(file: Path, line: bytes) -> None:
    """Append a line; it is on the disk when this returns, and not in the file if this raises.

    Raises:
        OSError: if the file cannot be written, or the disk stays full.
    """
    with _locked(file) as target:
        start = _cut_to_whole_lines(target)
        try:
            _write(target, line)
            os.fsync(target)
        except BaseException:
            os.ftruncate(target, start)
            raise


def cut_half_line(file: Path) -> None:
    """Remove an incomplete line at the end; the file is made if there is none.

    Raises:
        OSError: if the file cannot be written.
    """
    with _locked(file) as target:
        _cut_to_whole_lines(target)


class LineFile:
    """A journal: a file of lines to which several processes of one machine append."""

    def __init__(self, file: Path) -> None:
        """Use this file, which need not exist yet."""
        self.file = file

    def mend(self) -> None:
        """Remove an incomplete line that a power failure left.

        Raises:
            InputError: if the file cannot be written.
        """
        try:
            cut_half_line(self.file)
        except OSError as error:
            what = f"cannot be written: {error.strerror}"
            raise InputError(str(self.file), what, "choose another --out") from None

    def write(self, text: str) -> None:
        """Append a line; it is on the disk when this returns. Waits for room on a full disk.

        Raises:
            InputError: if it cannot be written; then nothing of it is in the file.
        """
        try:
            append_line(self.file, f"{text}\n".encode())
        except OSError as error:
            what = f"cannot be written: {error.strerror}"
            right = "make room; the same command goes on from here"
            raise InputError(str(self.file), what, right) from None

    @property
    def size(self) -> int:
        """Size in bytes."""
        return self.file.stat().st_size if self.file.exists() else 0

    def lines(self) -> list[bytes]:
        """All complete lines."""
        return self.file.read_bytes().split(b"\n")[:-1] if self.file.exists() else []


@contextmanager
def _locked(file: Path) -> Iterator[int]:
    target = os.open(file, os.O_RDWR | os.O_APPEND | os.O_CREAT, 0o644)
    try:
        if not stat.S_ISREG(os.fstat(target).st_mode):
            raise OSError(errno.EINVAL, "it is no plain file")
        fcntl.flock(target, fcntl.LOCK_EX)
        yield target
    finally:
        os.close(target)


def _cut_to_whole_lines(target: int) -> int:
    """Remove an incomplete line at the end; return the offset of the next line."""
    size = end = os.fstat(target).st_size
    while end:
        start = max(0, end - _TAIL)
        found = os.pread(target, end - start, start).rfind(b"\n")
        if found >= 0:
            end = start + found + 1
            break
        end = start
    if end < size:
        os.ftruncate(target, end)
    return end


def _write(target: int, line: bytes) -> None:
    latest = time.monotonic() + PATIENCE_S
    while line:
        try:
            line = line[os.write(target, line) :]
        except OSError as error:
            if error.errno not in _FULL or time.monotonic() > latest:
                raise
            time.sleep(_POLL_S)
