"""A voice: the program espeak-ng, which speaks by itself."""

import queue
import shutil
import subprocess
import threading
from contextlib import suppress

from executive.errors import InputError
from executive.text import one_line

PROGRAM = "espeak-ng"
RIGHT = "apt install espeak-ng, or leave --voice out"
MOST_CHARACTERS = 500
"""Of what is said aloud at a time: nobody listens longer."""
MOST_WAITING = 20
"""Sentences: what is said later than that is of no use any more."""


class EspeakVoice:
    """Implements `Voice`: one process a sentence, so that it can be silenced at once."""

    def __init__(self, program: str = PROGRAM) -> None:
        """Look for the program.

        Raises:
            InputError: if it is not installed.
        """
        found = shutil.which(program)
        if found is None:
            raise InputError(f"--voice {PROGRAM}", "there is no such program", RIGHT)
        self._command = [found, "--stdin"]
        self._waiting: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._speaking: subprocess.Popen[bytes] | None = None
        self._left = 0
        threading.Thread(target=self._speak, name="voice", daemon=True).start()

    def say(self, text: str) -> None:
        """Say it after what is being said."""
        words = one_line(text)[:MOST_CHARACTERS]
        with self._lock:
            if not words or self._left >= MOST_WAITING:
                return
            self._left += 1
        self._waiting.put(words)

    def hush(self) -> None:
        """Be silent at once."""
        with suppress(queue.Empty):
            while self._waiting.get_nowait() is not None:
                self._done()
        with self._lock:
            if self._speaking:
                self._speaking.kill()

    @property
    def speaks(self) -> bool:
        """Whether something is being said, or is about to be."""
        return self._left > 0

    def close(self) -> None:
        """Be silent for good."""
        self.hush()
        self._waiting.put(None)

    def _speak(self) -> None:
        while (words := self._waiting.get()) is not None:
            with suppress(OSError):
                self._run(words)
            self._done()

    def _run(self, words: str) -> None:
        """Words go in by a pipe: whatever they are, they are no option."""
        quiet = subprocess.DEVNULL
        with self._lock:
            self._speaking = subprocess.Popen(
                self._command, stdin=subprocess.PIPE, stdout=quiet, stderr=quiet
            )
        with suppress(OSError):
            self._speaking.communicate(words.encode())
        with self._lock:
            self._speaking = None

    def _done(self) -> None:
        with self._lock:
            self._left -= 1
