"""What the numbers of llama.cpp depend on, beside the model: how it was built, and what for."""

import platform
from importlib.util import find_spec
from pathlib import Path

CAN = ("flags", "Features")
"""What Linux calls that which a processor can do."""


def machine() -> tuple[object, ...]:
    """Tells this llama.cpp on this processor from others; llama.cpp is not loaded for it."""
    return platform.machine(), _processor(), _libraries()


def _processor() -> str:
    """What the processor can do, or how it is called where nobody says that."""
    try:
        with Path("/proc/cpuinfo").open() as lines:
            can = next((line for line in lines if line.startswith(CAN)), "")
    except (OSError, ValueError):
        can = ""
    return can or platform.processor()


def _libraries() -> tuple[tuple[str, int, int], ...]:
    """Its libraries: name, size and time."""
    spec = find_spec("llama_cpp")
    folders = (spec and spec.submodule_search_locations) or ()
    files = (path for folder in folders for path in Path(folder, "lib").glob("*"))
    return tuple(sorted((f.name, f.stat().st_size, f.stat().st_mtime_ns) for f in files))
