"""Identifies what results of llama.cpp depend on apart from the model: its build and processor."""

import platform
from importlib.util import find_spec
from pathlib import Path

CAN = ("flags", "Features")
"""The Linux names for the list of processor features."""


def machine() -> tuple[object, ...]:
    """A value that identifies llama.cpp's build and this processor; does not load llama.cpp."""
    return platform.machine(), _processor(), _libraries()


def _processor() -> str:
    """The processor's features; where the system does not list them, its name."""
    try:
        with Path("/proc/cpuinfo").open() as lines:
            can = next((line for line in lines if line.startswith(CAN)), "")
    except (OSError, ValueError):
        can = ""
    return can or platform.processor()


def _libraries() -> tuple[tuple[str, int, int], ...]:
    """llama.cpp's libraries: name, size (bytes) and modification time (ns)."""
    spec = find_spec("llama_cpp")
    folders = (spec and spec.submodule_search_locations) or ()
    files = (path for folder in folders for path in Path(folder, "lib").glob("*"))
    return tuple(sorted((f.name, f.stat().st_size, f.stat().st_mtime_ns) for f in files))
