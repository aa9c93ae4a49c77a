"""Caches a model's results in the user's cache folder, which may be deleted at any time.

Each result is a file. Its name is a hash of everything that the result depends on; its first bytes
are a hash of that name and the content. If it is damaged, or was made for another model, prompt,
processor or version, it is not found, and the result is computed and written again.
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
"""Increase this when results are computed in another way."""
MOST_BYTES = 64 << 20
"""Larger results are not kept."""
MOST_FILES = 2000
MOST_BYTES_IN_ALL = 256 << 20
"""Above these limits, the least recently used files are deleted."""
LOOKED_OVER_AFTER = 200
"""How many results are written before the limits are checked again."""
A_DAY_S = 86400.0
"""A file that is read is marked as used at most once in this time."""
_FOLDER = "read"
_DIGEST = 32

log = logging.getLogger(__name__)


class Kept:
    """The results of one model on this machine with these settings, by request."""

    def __init__(self, *about: object) -> None:
        """`about` identifies the model, machine and settings."""
        self._about = repr((VERSION, about))
        self._folder = cache_folder(_FOLDER)
        self._written = 0
        self._failed = False
        if self._folder:
            _evict(self._folder)

    def get(self, *asked: object) -> bytes | None:
        """The result of a request; None if it is not kept."""
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
        """Keep the result of a request, if there is a cache folder and it is not too large."""
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
            _evict(self._folder)

    def numbers(self, count: int | None, *asked: object) -> NDArray[np.float64] | None:
        """The numbers of a result, `count` (None: any number) and all finite; else None."""
        content = self.get(*asked)
        if content is None or len(content) != (len(content) // 8 if count is None else count) * 8:
            return None
        numbers = np.frombuffer(content, np.float64)
        return numbers.copy() if np.isfinite(numbers).all() else None

    def put_numbers(self, numbers: Sequence[float] | NDArray[np.float64], *asked: object) -> None:
        """Keep numbers as the result of a request."""
        self.put(np.asarray(numbers, np.float64).tobytes(), *asked)

    def _name(self, asked: tuple[object, ...]) -> str:
        return sha256(repr((self._about, asked)).encode()).hexdigest()


def _digest(name: str, content: bytes) -> bytes:
    return sha256(name.encode() + content).digest()


def _mark_as_used(path: Path) -> None:
    with suppress(OSError):
        if time.time() - path.stat().st_mtime > A_DAY_S:
            os.utime(path)


def _evict(folder: Path) -> None:
    """Delete the least recently used files above the limits; ignore errors."""
    with suppress(OSError):
        about = [(entry.stat(follow_symlinks=False), entry.path) for entry in os.scandir(folder)]
        room = MOST_BYTES_IN_ALL
        newest_first = sorted(about, key=lambda one: -one[0].st_mtime)
        for number, (stat, path) in enumerate(newest_first):
            room -= stat.st_size
            if number >= MOST_FILES or room < 0:
                with suppress(OSError):
                    os.unlink(path)
