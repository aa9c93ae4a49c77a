"""How every command of the project begins and ends: its signals, streams and exit status."""

import errno
import gc
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import wraps
from select import select
from types import FrameType
from typing import Any, Protocol

from executive.errors import ExecutiveError
from executive.shadows import shadow
from executive.terminal import open_closed_files, standard_streams
from executive.text import printable

DONE, NOT_DONE, BAD_INPUT, STOPPED = 0, 1, 2, 130

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
"""Ctrl-C, `kill`, the end of the terminal, Ctrl-\\: all of them say stop."""

STDERR = 2
"""Its file descriptor."""

Handler = Callable[[int, FrameType | None], None]


class EntryPoint(Protocol):
    """What `python -m PACKAGE` runs."""

    def __call__(self, arguments: Sequence[str] | None = None) -> int:
        """Run with these arguments (default: those of the process); return the exit status."""
        ...


_at_leave: list[Callable[[], None]] = []

_is_program = False
"""Whether the process is ours, and not one that calls a `main`."""


def begin() -> None:
    """What a program does first of all, before the imports that take long.

    A signal that says stop ends it without a traceback, also while it imports. If it would import
    what is not ours, it says so and ends.
    """
    global _is_program
    _is_program = True
    open_closed_files()
    handle_stop_signals(end_at_once)
    signal.signal(signal.SIGTTIN, signal.SIG_IGN)  # in the background nobody is there to ask
    if shadowed := shadow():
        print(f"error: {printable(shadowed)}", file=sys.stderr)
        leave(BAD_INPUT)


def end_at_once(number: int, frame: FrameType | None) -> None:
    """What a signal does while nothing is under way that must be ended in order."""
    if _is_program:
        _put_in_order()
        os._exit(STOPPED)
    raise KeyboardInterrupt


def entry_point(main: Callable[[Sequence[str] | None], int]) -> EntryPoint:
    """Have bad input told in a line, signals end the command, and `| head` read what it likes."""

    @wraps(main)
    def ended(arguments: Sequence[str] | None = None) -> int:
        gc.enable()
        with standard_streams(), on_stop_signals(_interrupt):
            try:
                return _flushed(main, arguments)
            except ExecutiveError as error:
                print(f"error: {printable(error)}", file=sys.stderr)
                return BAD_INPUT
            except PermissionError as error:
                named = printable(str(error.filename or "the system"))
                print(f"error: {named}: {error.strerror}; name what you may use", file=sys.stderr)
                return BAD_INPUT
            except KeyboardInterrupt:
                return STOPPED
            except BrokenPipeError as error:
                if error.errno != errno.EPIPE:
                    print(f"error: standard output: {error.strerror}", file=sys.stderr)
                return NOT_DONE

    return ended


@contextmanager
def all_is_kept() -> Iterator[None]:
    """Python looks for no garbage meanwhile, nor later among what there is then: it is in use.

    Looking takes a tenth of the time in which a program starts.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


@contextmanager
def on_stop_signals(handler: Handler) -> Iterator[None]:
    """Have this called when a signal says stop meanwhile; Python lets the main thread only."""
    before = handle_stop_signals(handler)
    try:
        yield
    finally:
        for number, earlier in before.items():
            signal.signal(number, earlier)


def stops_in_order(stop: Callable[[str], None], says: str) -> Handler:
    """Calls `stop` with whose the first signal is, and answers; a second Ctrl-C interrupts."""
    asked = False

    def handle(number: int, frame: FrameType | None) -> None:
        nonlocal asked
        if asked and number == signal.SIGINT:
            raise KeyboardInterrupt
        if not asked:
            asked = True
            stop("Ctrl-C" if number == signal.SIGINT else signal.Signals(number).name)
            with suppress(OSError):  # not `print`, which the signal may have interrupted
                if select([], [STDERR], [], 0)[1]:
                    os.write(STDERR, f"{says}\n".encode())

    return handle


def leave(status: int) -> None:
    """End the process now, whatever its threads do; what was printed is written first."""
    _put_in_order()
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            with suppress(OSError, ValueError):
                stream.flush()
    os._exit(status)


def at_leave(action: Callable[[], None]) -> None:
    """Have this done before the process ends: the terminal is put in order."""
    _at_leave.append(action)


def _put_in_order() -> None:
    while _at_leave:
        with suppress(Exception):
            _at_leave.pop()()


def leave_within(seconds: float, status: int) -> None:
    """End the process so much later, if it has not ended by itself then: a thread may be stuck."""
    if _is_program:
        timer = threading.Timer(seconds, leave, [status])
        timer.daemon = True
        timer.start()


def leave_stopping_to_the_parent() -> None:
    """For a command's worker processes, which a terminal's signals reach, too."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)


def _flushed(main: Callable[[Sequence[str] | None], int], arguments: Sequence[str] | None) -> int:
    """Its status, when all of its output is out; argparse ends with SystemExit."""
    try:
        status = main(arguments)
    except SystemExit:
        sys.stdout.flush()
        raise
    sys.stdout.flush()
    return status


def _interrupt(number: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def handle_stop_signals(handler: Handler) -> dict[signal.Signals, Any]:
    """Have this called when a signal says stop; return the handlers before.

    A command under `nohup` outlives its terminal.
    """
    if threading.current_thread() is not threading.main_thread():
        return {}
    nohup = signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    numbers = [number for number in STOP_SIGNALS if number != signal.SIGHUP or not nohup]
    return {number: signal.signal(number, handler) or signal.SIG_DFL for number in numbers}
