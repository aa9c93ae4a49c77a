"""The frame of every command of the project: signals, standard streams and exit status."""

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
"""Signals that mean stop: Ctrl-C, `kill`, the end of the terminal, Ctrl-\\."""

STDERR = 2
"""The file descriptor of standard error."""

Handler = Callable[[int, FrameType | None], None]


class EntryPoint(Protocol):
    """The main function of `python -m PACKAGE`."""

    def __call__(self, arguments: Sequence[str] | None = None) -> int:
        """Run with these arguments (default: those of the process); return the exit status."""
        ...


_at_leave: list[Callable[[], None]] = []

_is_program = False
"""Whether the process is one of our programs, and not another that calls a `main`."""


def begin() -> None:
    """Prepare the process; called first, before the imports that take long.

    From now on a stop signal ends the process without a traceback, also during imports. If a
    package of ours is shadowed, the process says so and ends.
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
    """Handle a stop signal while nothing has to be shut down in order."""
    if _is_program:
        _put_in_order()
        os._exit(STOPPED)
    raise KeyboardInterrupt


def entry_point(main: Callable[[Sequence[str] | None], int]) -> EntryPoint:
    """Wrap a main function: errors of input become one line, and stop signals an exit status."""

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
    """Pause garbage collection, and exclude all objects that exist at the end from it later.

    For imports: collection would take a tenth of a program's starting time.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


@contextmanager
def on_stop_signals(handler: Handler) -> Iterator[None]:
    """Handle stop signals so inside the block; outside of the main thread it does nothing."""
    before = handle_stop_signals(handler)
    try:
        yield
    finally:
        for number, earlier in before.items():
            signal.signal(number, earlier)


def stops_in_order(stop: Callable[[str], None], says: str) -> Handler:
    """A handler that calls `stop` with the first signal's name and prints `says`.

    A second Ctrl-C raises KeyboardInterrupt.
    """
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
    """Flush the output and end the process now, whatever its threads do."""
    _put_in_order()
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            with suppress(OSError, ValueError):
                stream.flush()
    os._exit(status)


def at_leave(action: Callable[[], None]) -> None:
    """Register an action to do before the process ends, such as restoring the terminal."""
    _at_leave.append(action)


def _put_in_order() -> None:
    while _at_leave:
        with suppress(Exception):
            _at_leave.pop()()


def leave_within(seconds: float, status: int) -> None:
    """End the process after this time if it has not ended by itself: a thread may be stuck."""
    if _is_program:
        timer = threading.Timer(seconds, leave, [status])
        timer.daemon = True
        timer.start()


def leave_stopping_to_the_parent() -> None:
    """Ignore the terminal's signals in a worker process: the parent handles them."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)


def _flushed(main: Callable[[Sequence[str] | None], int], arguments: Sequence[str] | None) -> int:
    """Run `main` and flush its output, also if argparse raises SystemExit; return its status."""
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
    """Install a handler for the stop signals; return the earlier handlers.

    Under `nohup`, SIGHUP stays ignored. Outside of the main thread, where Python allows no
    handlers, this does nothing.
    """
    if threading.current_thread() is not threading.main_thread():
        return {}
    nohup = signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    numbers = [number for number in STOP_SIGNALS if number != signal.SIGHUP or not nohup]
    return {number: signal.signal(number, handler) or signal.SIG_DFL for number in numbers}
