"""The cache folder: safe to delete, and used only if no other user can write to it."""

import os
from pathlib import Path

NAME = "robot-executive"
VARIABLE = "EXECUTIVE_CACHE"
NOWHERE = "none"
_WRITTEN_BY_OTHERS = 0o022


def cache_folder(part: str = "") -> Path | None:
    """The cache folder, or a folder in it; made if it does not exist.

    It is the folder that `EXECUTIVE_CACHE` names (`none`: no cache), else `robot-executive` in
    `XDG_CACHE_HOME`, else in `~/.cache` (XDG Base Directory Specification). None if it cannot be
    made, or if other users may write to it.
    """
    try:
        if (folder := _named()) is None:
            return None
        own = _own(folder)
        return folder / part if own and (not part or _own(folder / part)) else None
    except (OSError, RuntimeError):  # RuntimeError: the home folder is unknown
        return None


def _named() -> Path | None:
    if (named := os.environ.get(VARIABLE)) == NOWHERE:
        return None
    if named:
        return Path(named).expanduser().absolute()
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (base if base.is_absolute() else Path.home() / ".cache") / NAME


def _own(folder: Path) -> bool:
    """Make the folder if it does not exist; return whether only we can write to it."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    about = folder.stat()
    return about.st_uid == os.getuid() and not about.st_mode & _WRITTEN_BY_OTHERS
