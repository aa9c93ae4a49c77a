"""The first import of each program: it makes stop signals work during the slow imports after it.

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
...

The console commands start here, too. Unlike `python -m`, they do not import from the current
folder.
"""

import gc
import os
import sys
from types import TracebackType


def begin() -> None:
    """Let a stop signal end the program without a traceback, also during imports."""
    sys.excepthook = _quiet
    gc.disable()  # until `entry_point`: imported modules are never garbage
    from executive import shell  # takes 50 ms; a signal meanwhile raises KeyboardInterrupt

    shell.begin()


def robot_executive() -> None:
    """The command `robot-executive`, which is `python -m executive`."""
    _open("executive")


def robot_executive_campaign() -> None:
    """The command `robot-executive-campaign`, which is `python -m executive.campaign`."""
    _open("executive.campaign")


def robot_executive_kb() -> None:
    """The command `robot-executive-kb`, which is `python -m kb`."""
    _open("kb")


def robot_executive_logs() -> None:
    """The command `robot-executive-logs`, which is `python -m logs`."""
    _open("logs")


def robot_executive_sim() -> None:
    """The command `robot-executive-sim`, which is `python -m sim`."""
    _open("sim")


def robot_executive_trees() -> None:
    """The command `robot-executive-trees`, which is `python -m trees`."""
    _open("trees")


def _open(door: str) -> None:
    sys.excepthook = _quiet
    from runpy import run_module

    run_module(door, run_name="__main__", alter_sys=True)


def _quiet(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        os._exit(130)
    sys.__excepthook__(kind, error, trace)
