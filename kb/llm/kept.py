"""What a model worked out once and for all, kept in the user's cache folder: safe to delete.

Each piece is in a file of its own, whose name is a hash of all that it depends on, and which begins
with a hash of this name and of what it holds. What is damaged, moved, or of another model, prompt,
processor or version, is not found, and worked out and written anew.
"""

import logging
import os
import time
from collections.abc import Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from executive.cache import cache_folder
from executive.errors import InputError
from executive.files import read_bytes, write_whole

VERSION = 3
"""To be counted on when what is kept is worked out in another way."""
MOST_BYTES = 64 << 20
"""What is larger is not kept."""
MOST_FILES = 2000
MOST_BYTES_IN_ALL = 256 << 20
"""Of more, those go that were not asked for the longest."""
LOOKED_OVER_AFTER = 200
"""So many pieces are written before it is seen again whether there are too many."""
A_DAY_S = 86400.0
"""What was asked for is marked as such once in this time."""
_FOLDER = "read"
_DIGEST = 32

log = logging.getLogger(__name__)


class Kept:
    """What one model worked out, on this machine and with these settings, by what it was asked."""

    def __init__(self, *about: object) -> None:
        """Find what was worked out for one that is told from others by all of this."""
        self._about = repr((VERSION, about))
        self._folder = cache_folder(_FOLDER)
        self._written = 0
        self._failed = False
        if self._folder:
            _drop_what_is_too_much(self._folder)

    def get(self, *asked: object) -> bytes | None:
        """What came of it; None if it is not known."""
        if self._folder is None:
            return None
        path = self._folder / self._name(asked)
        try:
            whole = read_bytes(path, _DIGEST + MOST_BYTES)
        except InputError:
            return None
        digest, content = whole[:_DIGEST], whole[_DIGEST:]
        if digest != _digest(path.name, content):
            return None
        _mark_as_used(path)
        return content

    def put(self, content: bytes, *asked: object) -> None:
        """Keep what came of it, if there is a place for it."""
        if self._folder is None or len(content) > MOST_BYTES:
            return
        name = self._name(asked)
        try:
            write_whole(self._folder / name, _digest(name, content) + content)
        except OSError as error:
            if not self._failed:
                log.info("what the model has read is not kept: %s", error)
            self._failed = True
            return
        self._written += 1
        if self._written % LOOKED_OVER_AFTER == 0:
            _drop_what_is_too_much(self._folder)

    def numbers(self, count: int | None, *asked: object) -> NDArray[np.float64] | None:
        """So many finite numbers, or however many were kept; None if they are not known."""
        content = self.get(*asked)
        if content is None or len(content) != (len(content) // 8 if count is None else count) * 8:
            return None
        numbers = np.frombuffer(content, np.float64)
        return numbers.copy() if np.isfinite(numbers).all() else None

    def put_numbers(self, numbers: Sequence[float] | NDArray[np.float64], *asked: object) -> None:
        """Keep numbers."""
        self.put(np.asarray(numbers, np.float64).tobytes(), *asked)

    def _name(self, asked: tuple[object, ...]) -> str:
        return sha256(repr((self._about, asked)).encode()).hexdigest()


def _digest(name: str, content: bytes) -> bytes:
    return sha256(name.encode() + content).digest()


def _mark_as_used(path: Path) -> None:
    with suppress(OSError):
        if time.time() - path.stat().st_mtime > A_DAY_S:
            os.utime(path)


def _drop_what_is_too_much(folder: Path) -> None:
    """The newest stay, as far as there is room; what cannot be dropped stays, too."""
    with suppress(OSError):
        about = [(entry.stat(follow_symlinks=False), entry.path) for entry in os.scandir(folder)]
        room = MOST_BYTES_IN_ALL
        newest_first = sorted(about, key=lambda one: -one[0].st_mtime)
        for number, (stat, path) in enumerate(newest_first):
            room -= stat.st_size
            if number >= MOST_FILES or room < 0:
                with suppress(OSError):
                    os.unlink(path)
