"""What a piece of code opens, imports, runs or connects to, as Python's audit events tell."""

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

TELLING = ("open", "import", "exec", "compile", "socket.", "subprocess.", "os.system", "os.exec")
TELLING += ("os.spawn", "os.posix_spawn", "urllib.", "ctypes.", "shutil.", "os.remove", "os.rename")

_watching: list[list[str]] = []


def _note(event: str, arguments: tuple[Any, ...]) -> None:
    if _watching and event.startswith(TELLING) and threading.current_thread().name == "MainThread":
        about = str(arguments[0]) if arguments else ""
        _watching[-1].append(f"{event} {about}")


sys.addaudithook(_note)


@contextmanager
def watched(*allowed: Path) -> Iterator[list[str]]:
    """All that is touched within, other than that these files are opened."""
    touched: list[str] = []
    _watching.append(touched)
    try:
        yield touched
    finally:
        _watching.pop()
        fine = {f"open {path}" for path in allowed}
        touched[:] = [one for one in touched if one not in fine]
