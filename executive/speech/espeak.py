"""A voice: the program espeak-ng, which speaks by itself."""

import re
import shutil
import subprocess
import threading
from collections import deque
from contextlib import suppress

from executive.errors import InputError
from executive.text import one_line

PROGRAM = "espeak-ng"
RIGHT = "apt install espeak-ng, or leave --voice out"
MOST_CHARACTERS = 500
"""Of what is said aloud at a time: nobody listens longer."""
MOST_WAITING = 20
"""Sentences: what is said later than that is of no use any more."""
_STOP = re.compile(r"\bstop(ped|ping|s)?\b", re.IGNORECASE)
_HALT = {"": "halt", "ped": "halted", "ping": "halting", "s": "halts"}


class EspeakVoice:
    """Implements `Voice`: one process a sentence, so that it can be silenced at once.

    It says "halt" for "stop": whoever listens for a stop would hear the robot's own.
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
        """What is being said, and after it what waits."""
        self._changed = threading.Condition()
        self._speaking: subprocess.Popen[bytes] | None = None
        self._closed = False
        threading.Thread(target=self._speak, name="voice", daemon=True).start()

    def say(self, text: str) -> None:
        """Say it after what is being said."""
        words = _STOP.sub(_halt, one_line(text)[:MOST_CHARACTERS])
        with self._changed:
            if words and len(self._texts) < MOST_WAITING:
                self._texts.append(words)
                self._changed.notify()

    def hush(self) -> None:
        """Be silent at once."""
        with self._changed:
            if self._speaking:
                self._speaking.kill()
            while len(self._texts) > (1 if self._speaking else 0):
                self._texts.pop()

    @property
    def saying(self) -> str:
        """All of it in a line."""
        with self._changed:
            return " ".join(self._texts)

    def close(self) -> None:
        """Be silent for good."""
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
        """Wait for what is to be said, and say it.

        Words go in by a pipe: whatever they are, they are no option.
        """
        quiet = subprocess.DEVNULL
        with self._changed:
            self._changed.wait_for(lambda: self._texts or self._closed)
            if self._closed:
                return
            words = self._texts[0]
            self._speaking = process = subprocess.Popen(
                self._command, stdin=subprocess.PIPE, stdout=quiet, stderr=quiet
            )
        process.communicate(words.encode())


def _halt(found: re.Match[str]) -> str:
    return _HALT[(found[1] or "").lower()]
