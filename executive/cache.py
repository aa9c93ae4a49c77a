"""Where is kept what can be computed again: safe to delete, and used only if it is one's own."""

import os
from pathlib import Path

NAME = "robot-executive"
VARIABLE = "EXECUTIVE_CACHE"
NOWHERE = "none"
_WRITTEN_BY_OTHERS = 0o022


def cache_folder(part: str = "") -> Path | None:
    """The folder, or a part of it, made if it is not there.

    It is the one that `EXECUTIVE_CACHE` names (`none`: there is none), else `robot-executive` in
    `XDG_CACHE_HOME`, else in `~/.cache` (XDG Base Directory Specification). None if there can be
    none, or others may write in it.
    """
    try:
        if (folder := _named()) is None:
            return None
        own = _own(folder)
        return folder / part if own and (not part or _own(folder / part)) else None
    except (OSError, RuntimeError):  # the latter if nobody knows where home is
        return None


def _named() -> Path | None:
    if (named := os.environ.get(VARIABLE)) == NOWHERE:
        return None
    if named:
        return Path(named).expanduser().absolute()
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (base if base.is_absolute() else Path.home() / ".cache") / NAME


def _own(folder: Path) -> bool:
    """Make it if it is not there; whether it is ours alone."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    about = folder.stat()
    return about.st_uid == os.getuid() and not about.st_mode & _WRITTEN_BY_OTHERS
