"""Ears take their time, a server's more than ours: they hear on a thread of their own.

So a stop is listened for also while they think about what was said before.
"""

import logging
import queue
import threading
import time
from dataclasses import dataclass

from executive.speech.doubt import Doubt
from executive.speech.interfaces import Ears, Reading
from executive.speech.overlap import Overlap
from executive.speech.sound import RATE_HZ, Sound

MOST_WAITING = 3
"""Utterances: who says more meanwhile is told so."""
log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Said:
    """An utterance, when it began, and in which turn."""

    turn: int
    began: float
    sound: Sound
    overlap: Overlap


class Hearing:
    """One utterance after the other goes to the ears, and what they make of it to the doubt."""

    def __init__(self, ears: Ears, doubt: Doubt) -> None:
        """Wait for the first one."""
        self._ears = ears
        self._doubt = doubt
        self._waiting: queue.Queue[_Said | None] = queue.Queue(MOST_WAITING)
        self._turn = 0
        """What was said in an earlier turn is forgotten."""
        self._thread = threading.Thread(target=self._hear, name="hearing", daemon=True)
        self._thread.start()

    def add(self, sound: Sound, overlap: Overlap) -> None:
        """Hear this, which has just ended, after what waits already."""
        began = time.monotonic() - len(sound) / RATE_HZ
        try:
            self._waiting.put_nowait(_Said(self._turn, began, sound, overlap))
        except queue.Full:
            self._doubt.missed()

    def forget(self) -> None:
        """Whatever was said so far counts no more."""
        self._turn += 1

    def settle(self) -> None:
        """Return when all of it was heard."""
        self._waiting.join()

    def finish(self) -> None:
        """Return when all of it was heard; nothing is heard after that."""
        self._waiting.put(None)
        self._thread.join()

    def _hear(self) -> None:
        while (said := self._waiting.get()) is not None:
            if said.turn == self._turn:
                self._hear_one(said)
            self._waiting.task_done()

    def _hear_one(self, said: _Said) -> None:
        try:
            reading = self._ears.hear(said.sound)
        except Exception as error:  # ears of others must not end all hearing
            log.warning("%s failed: %r", self._ears.name, error)
            reading = Reading(self._ears.name, "", problem="the ears failed")
        if said.turn == self._turn:
            self._doubt.hear(reading, said.overlap, said.began)
