"""How every command of the project ends: its exit status, and a line that says why."""

import os
import signal
import sys
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Protocol

from executive.errors import ExecutiveError

DONE, NOT_DONE, BAD_INPUT, STOPPED = 0, 1, 2, 130


class EntryPoint(Protocol):
    """What `python -m PACKAGE` runs."""

    def __call__(self, arguments: Sequence[str] | None = None) -> int:
        """Run with these arguments (default: those of the process); return the exit status."""
        ...


def entry_point(main: Callable[[Sequence[str] | None], int]) -> EntryPoint:
    """Have bad input told in a line, Ctrl-C end the command, and `| head` read what it likes."""

    @wraps(main)
    def ended(arguments: Sequence[str] | None = None) -> int:
        try:
            status = main(arguments)
            sys.stdout.flush()
            return status
        except ExecutiveError as error:
            print(f"error: {error}", file=sys.stderr)
            return BAD_INPUT
        except KeyboardInterrupt:
            return STOPPED
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return NOT_DONE

    return ended


def leave_stopping_to_the_parent() -> None:
    """For a command's worker processes, which a terminal's Ctrl-C reaches, too."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
