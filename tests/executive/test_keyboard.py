"""A person at a terminal has a prompt while they are asked; the terminal is left as it was."""

import fcntl
import os
import pty
import select
import signal
import subprocess
import sys
import termios
import time
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path

import pytest
from patience import PATIENCE_S

ROBOT = [sys.executable, "-m", "executive", "--world", "fake", "--llm", "none", "--search", "paper"]
ASKED = "quit ends the session"
PROMPT = "> "


class Typist:
    """A program at a terminal, and what it shows."""

    def __init__(self, *arguments: str, **environment: str) -> None:
        self.keys, self.terminal = pty.openpty()
        self.before = termios.tcgetattr(self.terminal)
        self.shown = ""
        self.process = subprocess.Popen(
            [*ROBOT, *arguments],
            stdin=self.terminal,
            stdout=self.terminal,
            stderr=self.terminal,
            start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),  # Ctrl-C comes from it
            env={**os.environ, "TERM": "xterm", **environment},
        )

    def sees(self, words: str) -> str:
        """Wait until it is shown; what came before it is forgotten."""
        ends = time.monotonic() + PATIENCE_S
        while words not in self.shown:
            assert time.monotonic() < ends, f"never shows {words!r}, but {self.shown!r}"
            if select.select([self.keys], [], [], 0.1)[0]:
                self.shown += os.read(self.keys, 4096).decode(errors="replace")
        before, _, self.shown = self.shown.partition(words)
        return before

    def sees_both(self, one: str, other: str) -> None:
        """Wait until both are shown; threads say them, which comes first is not known."""
        before = self.sees(one)
        if other not in before:
            self.sees(other)

    def types(self, keys: str) -> None:
        os.write(self.keys, keys.encode())

    def ends_with(self) -> int:
        status = self.process.wait(PATIENCE_S)
        assert termios.tcgetattr(self.terminal) == self.before
        return status

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        for number in (self.keys, self.terminal):
            with suppress(OSError):
                os.close(number)


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("NO_COLOR", raising=False)


@pytest.fixture
def typist() -> Iterator[Typist]:
    with closing(Typist()) as typist:
        yield typist


def test_a_line_is_edited_and_found_again_in_the_history(typist: Typist) -> None:
    typist.sees(ASKED)
    typist.sees(PROMPT)
    typist.types("Find an applx\x7fe\r")
    typist.sees("Where is the apple?")
    typist.sees(PROMPT)
    typist.types("dining table\r")
    typist.sees("The apple is on the dining table")
    typist.sees("What can I do for you?")
    typist.sees(PROMPT)
    typist.types("\x1b[A\x1b[A\r")
    typist.sees("Find an apple")
    typist.sees("The apple is on the dining table")
    typist.sees("What can I do for you?")
    typist.sees(PROMPT)
    typist.types("quit\r")
    assert typist.ends_with() == 0


def test_ctrl_c_at_the_prompt_stops_what_is_asked_about(typist: Typist) -> None:
    typist.sees(ASKED)
    typist.sees(PROMPT)
    typist.types("Find an apple\r")
    typist.sees("Where is the apple?")
    typist.sees(PROMPT)
    typist.types("\x03")
    typist.sees_both("Stopping.", "stopped by Ctrl-C")
    assert typist.ends_with() == 130


def test_the_end_of_the_input_ends_the_session(typist: Typist) -> None:
    typist.sees(ASKED)
    typist.sees(PROMPT)
    typist.types("\x04")
    assert typist.ends_with() == 0


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_takes_the_prompt_away(typist: Typist, number: signal.Signals) -> None:
    typist.sees(ASKED)
    typist.sees(PROMPT)
    typist.process.send_signal(number)
    assert typist.ends_with() == 130


def test_a_question_that_is_not_answered_in_time_takes_its_prompt_away(tmp_path: Path) -> None:
    (tmp_path / "hasty.toml").write_text("answer_timeout_s = 1.0")
    with closing(Typist("--config", "hasty.toml", "Find", "an", "apple")) as typist:
        typist.sees("Where is the apple?")
        typist.sees("nobody answered within 1 s")
        assert typist.ends_with() == 1


@pytest.mark.parametrize(("environment", "colored"), [({}, True), ({"NO_COLOR": "1"}, False)])
def test_colors_are_shown_unless_nobody_wants_them(
    environment: dict[str, str], colored: bool
) -> None:
    with closing(Typist("Come here", **environment)) as typist:
        assert ("\x1b[36m" in typist.sees("Here I am.")) == colored
        assert typist.ends_with() == 0
