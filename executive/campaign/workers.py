"""Starts worker processes as forks of one process that has imported all that missions need.

This module is quick to import, so that the imports there begin before ours.
"""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import get_context, set_forkserver_preload
from multiprocessing.context import BaseContext

LOADED = "executive.campaign.loaded"
"""The module that is imported before workers are forked; it starts no thread."""
FORKS = sys.platform != "darwin"
"""On macOS, system libraries may start threads, which makes forking unsafe."""


def start_loading() -> BaseContext:
    """Start the process from which workers are forked; return the multiprocessing context."""
    if not FORKS:
        return get_context("spawn")
    from multiprocessing import forkserver  # not for --help

    set_forkserver_preload([LOADED])
    with _stop_signals_held(), _importing_as_here():
        forkserver.ensure_running()
    return get_context("forkserver")


@contextmanager
def _stop_signals_held() -> Iterator[None]:
    """Block the terminal's signals inside the block: processes started there inherit that.

    This process gets them when the block ends.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGHUP))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _importing_as_here() -> Iterator[None]:
    """Let processes started inside the block import from the same paths as this one, in order.

    Without `PYTHONSAFEPATH`, the current folder would come first.
    """
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
