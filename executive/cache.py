"""Where is kept what can be computed again: safe to delete, and used only if it is one's own."""

import os
from pathlib import Path

NAME = "robot-executive"
_WRITTEN_BY_OTHERS = 0o022


def cache_folder() -> Path | None:
    """The folder, made if it is not there; None if there can be none, or others may write in it.

    It is in `XDG_CACHE_HOME`, else in `~/.cache` (XDG Base Directory Specification).
    """
    try:
        given = Path(os.environ.get("XDG_CACHE_HOME", ""))
        folder = (given if given.is_absolute() else Path.home() / ".cache") / NAME
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        about = folder.stat()
    except (OSError, RuntimeError):  # the latter if nobody knows where home is
        return None
    ours = about.st_uid == os.getuid() and not about.st_mode & _WRITTEN_BY_OTHERS
    return folder if ours else None
