"""How long tests wait for what must come: a machine may be busy with seventy other things."""

import time
from collections.abc import Callable

PATIENCE_S = 600.0
"""Nothing that comes at all takes so long."""
LOOK_S = 0.01


def until(happens: Callable[[], object], what: str = "it") -> None:
    """Wait until this is true."""
    latest = time.monotonic() + PATIENCE_S
    while not happens():
        assert time.monotonic() < latest, f"{what} never came to be"
        time.sleep(LOOK_S)


def until_still(count: Callable[[], int], for_s: float = 0.15) -> int:
    """Wait until what is counted has stayed the same for so long; how much it is."""
    latest, before = time.monotonic() + PATIENCE_S, count() - 1
    while (now := count()) != before:
        assert time.monotonic() < latest, "it never comes to rest"
        before = now
        time.sleep(for_s)
    return now
