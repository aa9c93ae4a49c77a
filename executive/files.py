"""Safe reading of files from outside, and atomic writing of our own.

Only regular files of limited size are read: a named pipe or a device could block, or never end.
"""

import codecs
import os
import stat
from contextlib import suppress
from pathlib import Path

from executive.errors import InputError

MOST_TEXT_BYTES = 4 * 2**20
"""Files that a person writes by hand are smaller."""
_WIDE = (codecs.BOM_UTF32_LE, codecs.BOM_UTF32_BE, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
"""Byte order marks of files that some editors save as "Unicode"."""


def read_bytes(path: Path, most: int, where: str = "", right: str = "") -> bytes:
    """The content of a regular file of at most `most` bytes.

    Args:
        path: the file.
        most: the largest size in bytes.
        where: what to call the file in messages (default: its path).
        right: what to give instead of a file that cannot be read.

    Raises:
        InputError: if it cannot be read, is not a regular file, or is larger.
    """
    where = where or str(path)
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            kind = "a folder" if path.is_dir() else "a pipe or a device"
            raise InputError(where, f"cannot be read: it is {kind}", right or "give a plain file")
        with path.open("rb") as stream:
            content = stream.read(most + 1)
    except OSError as error:
        raise InputError(where, f"cannot be read: {error.strerror}", right) from None
    except ValueError:
        raise InputError(where, "cannot be read: it is no name of a file", right) from None
    if len(content) > most:
        raise InputError(where, f"is larger than {_size(most)}", right or "give a smaller file")
    return content


def read_text(path: Path, where: str = "", right: str = "", most: int = MOST_TEXT_BYTES) -> str:
    """The text of a regular file, without a byte order mark.

    Raises:
        InputError: as `read_bytes`, or if it is not UTF-8 text.
    """
    return decoded(read_bytes(path, most, where, right), where or str(path))


def decoded(content: bytes, where: str) -> str:
    """The content decoded as UTF-8, without a byte order mark.

    Raises:
        InputError: if it is not UTF-8.
    """
    if content.startswith(_WIDE):
        raise InputError(where, "is not UTF-8 text: it is UTF-16 or UTF-32", "save it as UTF-8")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        what = f"is not UTF-8 text: line {line} has the byte 0x{content[error.start]:02x}"
        raise InputError(where, what, "save it as UTF-8") from None


def write_whole(file: Path, content: bytes) -> None:
    """Write a file atomically; it is on the disk when this returns.

    Raises:
        OSError: if that fails; the old content is still there.
    """
    new = file.with_name(f".{file.name}.{os.getpid()}.new")
    try:
        with new.open("wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        new.replace(file)
    except BaseException:
        with suppress(OSError):
            new.unlink()
        raise


def _size(count: int) -> str:
    return f"{count >> 20} MB" if count >= 1 << 20 else f"{count >> 10} kB"
