"""Worker processes are forked off one process that has loaded all that missions import.

It takes next to nothing to import this, so that the loading begins before that of the rest.
"""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import get_context, set_forkserver_preload
from multiprocessing.context import BaseContext

LOADED = "executive.campaign.loaded"
"""What is imported before a worker is forked off; no thread of ours runs in it."""
FORKS = sys.platform != "darwin"
"""On macOS the system's own libraries may have threads, which no fork survives."""


def start_loading() -> BaseContext:
    """How workers are made; the process that they are forked off begins to load, if it has not."""
    if not FORKS:
        return get_context("spawn")
    from multiprocessing import forkserver  # not for --help

    set_forkserver_preload([LOADED])
    with _stop_signals_held(), _importing_as_here():
        forkserver.ensure_running()
    return get_context("forkserver")


@contextmanager
def _stop_signals_held() -> Iterator[None]:
    """What is started meanwhile never hears those that a terminal sends to all; we do, later."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGHUP))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _importing_as_here() -> Iterator[None]:
    """What is started meanwhile imports from where we do, and from nowhere before that."""
    path = os.pathsep.join(map(os.path.abspath, sys.path))
    ours = {"PYTHONSAFEPATH": "1", "PYTHONPATH": path}
    before = {name: os.environ[name] for name in ours if name in os.environ}
    os.environ.update(ours)
    try:
        yield
    finally:
        for name in ours:
            del os.environ[name]
        os.environ.update(before)
