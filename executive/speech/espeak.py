"""A voice by the program espeak-ng."""

import logging
import re
import shutil
import subprocess
import threading
from collections import deque
from contextlib import suppress

from executive.errors import InputError
from executive.text import one_line, printable

PROGRAM = "espeak-ng"
RIGHT = "apt install espeak-ng, or leave --voice out"
MOST_CHARACTERS = 500
"""Longer texts are cut after this many characters: nobody listens longer."""
MOST_WAITING = 20
"""The longest queue of sentences; others are dropped: they would come too late to be of use."""
FAULT = "error: "
_STOP = re.compile(r"\bstop(ped|ping|s)?\b", re.IGNORECASE)
_HALT = {"": "halt", "ped": "halted", "ping": "halting", "s": "halts"}
log = logging.getLogger(__name__)


class EspeakVoice:
    """Implements `Voice` with one process per sentence, so that it can be silenced at once.

    It says "halt" for "stop", so that the stop spotter does not hear the robot's own word.
    """

    def __init__(self, program: str = PROGRAM) -> None:
        """Look for the program.

        Raises:
            InputError: if it is not installed.
        """
        found = shutil.which(program)
        if found is None:
            raise InputError(f"--voice {PROGRAM}", "there is no such program", RIGHT)
        self._command = [found, "--stdin"]
        self._texts: deque[str] = deque()
        """The current sentence, then those that wait."""
        self._changed = threading.Condition()
        self._speaking: subprocess.Popen[bytes] | None = None
        self._closed = self._is_faulty = False
        threading.Thread(target=self._speak, name="voice", daemon=True).start()

    def say(self, text: str) -> None:
        """Queue a sentence."""
        words = _STOP.sub(_halt, one_line(text)[:MOST_CHARACTERS])
        with self._changed:
            if words and len(self._texts) < MOST_WAITING:
                self._texts.append(words)
                self._changed.notify()

    def hush(self) -> None:
        """Stop speaking at once, and clear the queue."""
        with self._changed:
            if self._speaking:
                self._speaking.kill()
            while len(self._texts) > (1 if self._speaking else 0):
                self._texts.pop()

    @property
    def saying(self) -> str:
        """The current and the waiting sentences, on one line."""
        with self._changed:
            return " ".join(self._texts)

    def close(self) -> None:
        """Stop speaking, and end the thread."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self.hush()

    def _speak(self) -> None:
        while not self._closed:
            with suppress(OSError):
                self._say_next()
            with self._changed:
                self._speaking = None
                if self._texts:
                    self._texts.popleft()

    def _say_next(self) -> None:
        """Wait for the next sentence, and say it.

        Words are passed by a pipe, so that they are never taken for an option.
        """
        quiet = subprocess.DEVNULL
        with self._changed:
            self._changed.wait_for(lambda: self._texts or self._closed)
            if self._closed:
                return
            words = self._texts[0]
            self._speaking = process = subprocess.Popen(
                self._command, stdin=subprocess.PIPE, stdout=quiet, stderr=subprocess.PIPE
            )
        _, said = process.communicate(words.encode())
        self._warn_of_errors(said.decode(errors="replace"))

    def _warn_of_errors(self, said: str) -> None:
        """Warn once of an error message: without a loudspeaker, the program still exits with 0."""
        faults = [line for line in said.splitlines() if line.lower().startswith(FAULT)]
        if faults and not self._is_faulty:
            self._is_faulty = True
            log.warning("%s cannot be heard: %s", PROGRAM, printable(faults[-1][len(FAULT) :]))


def _halt(found: re.Match[str]) -> str:
    return _HALT[(found[1] or "").lower()]
