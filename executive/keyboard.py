"""Keyboard input from a terminal: a prompt with line editing and history while a question is open.

Otherwise the terminal is left as it is: lines are read as by any other program, and what the robot
prints disturbs no prompt.
"""

import os
import signal
import sys
import termios
import threading
from collections.abc import Iterator
from contextlib import suppress
from select import select
from typing import TYPE_CHECKING, TextIO

from executive.cache import cache_folder
from executive.shell import at_leave
from executive.terminal import Terminal

if TYPE_CHECKING:
    from prompt_toolkit import PromptSession

PROMPT = "> "
POLL_S = 0.05
"""How often (s) to check whether a prompt is wanted or a line was typed."""
CLOSED_S = 0.5
"""How long (s) the prompt may take to restore the terminal."""


class Keyboard:
    """Reads typed lines; `prompt` and `rest` may be called from any thread."""

    def __init__(self, source: TextIO, screen: TextIO) -> None:
        """Read from one terminal, show the prompt on another, usually the same."""
        self._source, self._screen = source, screen
        self._asked = threading.Event()
        self._at_rest = threading.Event()
        self._at_rest.set()
        self._session: PromptSession[str | None] | None = None
        self._as_it_was = termios.tcgetattr(source)
        at_leave(self._close)

    def prompt(self) -> None:
        """Show a prompt."""
        self._asked.set()

    def rest(self) -> None:
        """Remove the prompt, if there is one."""
        self._asked.clear()
        self._end_prompt()

    def lines(self) -> Iterator[str]:
        """Each line, as it is typed; ends at the end of the input."""
        while True:
            line = self._edited() if self._asked.is_set() and self._is_ours() else self._plain()
            if line is None:
                continue
            if not line:
                return
            yield line

    def _plain(self) -> str | None:
        """A line in the terminal's own line mode; None if there is none yet."""
        try:
            ready = select([self._source], [], [], POLL_S)[0]
            return self._source.readline() if ready else None
        except (OSError, ValueError):
            return ""

    def _edited(self) -> str | None:
        """A line typed at the prompt; None if the prompt was removed, empty at end of input."""
        self._at_rest.clear()
        try:
            self._session = self._session or _session(self._source, self._screen)
            line = self._session.prompt(handle_sigint=False, pre_run=self._look_again)
            return None if line is None else f"{line}\n"
        except KeyboardInterrupt:
            os.kill(os.getpid(), signal.SIGINT)  # at a prompt, Ctrl-C is a key, not a signal
            self._asked.clear()
            return None
        except (EOFError, OSError, ValueError):
            return ""
        finally:
            self._at_rest.set()

    def _look_again(self) -> None:
        """Remove the prompt if the question was withdrawn while the prompt was being shown."""
        if not self._asked.is_set():
            self._end_prompt()

    def _end_prompt(self) -> None:
        app = self._session.app if self._session else None
        if app and app.is_running and app.loop:
            with suppress(RuntimeError):  # it has just ended
                app.loop.call_soon_threadsafe(self._exit)

    def _exit(self) -> None:
        if self._session and not self._asked.is_set():
            with suppress(Exception):  # it has just ended, or a line has
                self._session.app.exit(result=None)

    def _is_ours(self) -> bool:
        """Whether we may change the terminal's mode: a background process must not."""
        with suppress(OSError):
            return os.tcgetpgrp(self._source.fileno()) == os.getpgrp()
        return False

    def _close(self) -> None:
        """Restore the terminal's mode."""
        self.rest()
        self._at_rest.wait(CLOSED_S)
        if self._is_ours():
            with suppress(termios.error, OSError, ValueError):
                termios.tcsetattr(self._source, termios.TCSANOW, self._as_it_was)


def keyboard_of(source: TextIO, out: TextIO) -> Keyboard | None:
    """A keyboard if both streams are a terminal; None for pipes and files."""
    screen = out.screen if isinstance(out, Terminal) else out
    is_plain = os.environ.get("TERM", "dumb") == "dumb"
    if screen is None or is_plain or source is not sys.stdin:
        return None
    try:
        return Keyboard(source, screen) if source.isatty() and screen.isatty() else None
    except (OSError, ValueError, termios.error):
        return None


def _session(source: TextIO, screen: TextIO) -> "PromptSession[str | None]":
    from prompt_toolkit import PromptSession  # slow to import, and scripts do not need it
    from prompt_toolkit.history import FileHistory, InMemoryHistory
    from prompt_toolkit.input import create_input
    from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
    from prompt_toolkit.output import create_output
    from prompt_toolkit.output.vt100 import Vt100_Output

    keys = KeyBindings()

    @keys.add("c-\\")
    def quit_(event: KeyPressEvent) -> None:
        os.kill(os.getpid(), signal.SIGQUIT)

    output = create_output(screen)
    if isinstance(output, Vt100_Output):
        output.enable_cpr = False  # some terminals do not report the cursor position
    folder = cache_folder()
    return PromptSession(
        [("ansigreen", PROMPT)],
        history=FileHistory(str(folder / "said")) if folder else InMemoryHistory(),
        key_bindings=keys,
        enable_suspend=True,
        input=create_input(source),
        output=output,
    )
