"""The first thing that a door imports, before all that takes long; itself it takes next to nothing.

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
...
"""

import os
import sys
from types import TracebackType


def begin() -> None:
    """Have a signal that says stop end the program without a traceback, also while it imports."""
    sys.excepthook = _quiet
    from executive import shell  # takes 50 ms, in which Python raises KeyboardInterrupt

    shell.begin()


def _quiet(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        os._exit(130)
    sys.__excepthook__(kind, error, trace)
