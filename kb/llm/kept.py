"""What a model worked out once and for all, kept in the user's cache folder: safe to delete.

Each piece is in a file of its own, whose name is a hash of all that it depends on, and which begins
with a hash of what it holds. What is damaged, or of another model, prompt, processor or version, is
not found, and worked out anew.
"""

import logging
import os
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

import numpy as np

from executive.cache import cache_folder
from executive.geometry import Floats

VERSION = 1
"""To be counted on when what is kept is worked out in another way."""
MOST_BYTES = 64 << 20
"""What is larger is not kept."""
MOST_FILES = 2000
"""Of more, the oldest go."""
_FOLDER = "read"
_DIGEST = 32

log = logging.getLogger(__name__)


class Kept:
    """What one model worked out, on this machine and with these settings, by what it was asked."""

    def __init__(self, *about: object) -> None:
        """Find what was worked out for one that is told from others by all of this."""
        self._about = repr((VERSION, about))
        self._folder = _folder()

    def get(self, *asked: object) -> bytes | None:
        """What came of it; None if it is not known."""
        if self._folder is None:
            return None
        try:
            with (self._folder / self._name(asked)).open("rb") as file:
                digest, content = file.read(_DIGEST), file.read(MOST_BYTES + 1)
        except OSError:
            return None
        return content if digest == sha256(content).digest() else None

    def put(self, content: bytes, *asked: object) -> None:
        """Keep what came of it, if there is a place for it."""
        if self._folder is None or len(content) > MOST_BYTES:
            return
        try:
            handle, path = tempfile.mkstemp(dir=self._folder)
            with os.fdopen(handle, "wb") as file:
                file.write(sha256(content).digest() + content)
            os.replace(path, self._folder / self._name(asked))
        except OSError as error:
            log.info("what the model has read is not kept: %s", error)

    def numbers(self, count: int, *asked: object) -> Floats | None:
        """So many finite numbers; None if they are not known."""
        content = self.get(*asked)
        if content is None or len(content) != count * 8:
            return None
        numbers = np.frombuffer(content, np.float64)
        return numbers.copy() if np.isfinite(numbers).all() else None

    def put_numbers(self, numbers: Sequence[float] | Floats, *asked: object) -> None:
        """Keep numbers."""
        self.put(np.asarray(numbers, np.float64).tobytes(), *asked)

    def _name(self, asked: tuple[object, ...]) -> str:
        return sha256(repr((self._about, asked)).encode()).hexdigest()


def _folder() -> Path | None:
    """Where all is kept, less what is too much; None if there is no place."""
    if (cache := cache_folder()) is None:
        return None
    folder = cache / _FOLDER
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        files = sorted(folder.iterdir(), key=lambda path: path.stat().st_mtime)
    except OSError:
        return None
    with suppress(OSError):
        for path in files[:-MOST_FILES]:
            path.unlink()
    return folder
