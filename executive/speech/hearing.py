"""Speech recognition on a thread of its own, as it takes time, with a server even more.

So the stop spotter listens also while an earlier utterance is recognised.
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
"""The longest queue of utterances; the person is told if one is dropped."""
log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Utterance:
    """An utterance, when it began (by `time.monotonic`), and its turn."""

    turn: int
    began: float
    sound: Sound
    overlap: Overlap


class Hearing:
    """Passes one utterance after the other to the ears, and their readings to `Doubt`."""

    def __init__(self, ears: Ears, doubt: Doubt) -> None:
        """Start the thread."""
        self._ears = ears
        self._doubt = doubt
        self._waiting: queue.Queue[_Utterance | None] = queue.Queue(MOST_WAITING)
        self._turn = 0
        """Readings of utterances from an earlier turn are dropped."""
        self._thread = threading.Thread(target=self._hear, name="hearing", daemon=True)
        self._thread.start()

    def add(self, sound: Sound, overlap: Overlap) -> None:
        """Queue an utterance that has just ended."""
        began = time.monotonic() - len(sound) / RATE_HZ
        try:
            self._waiting.put_nowait(_Utterance(self._turn, began, sound, overlap))
        except queue.Full:
            self._doubt.missed()

    def forget(self) -> None:
        """Drop all utterances so far."""
        self._turn += 1

    def settle(self) -> None:
        """Block until all utterances were recognised."""
        self._waiting.join()

    def finish(self) -> None:
        """Block until all utterances were recognised, and end the thread."""
        self._waiting.put(None)
        self._thread.join()

    def _hear(self) -> None:
        while (said := self._waiting.get()) is not None:
            if said.turn == self._turn:
                self._hear_one(said)
            self._waiting.task_done()

    def _hear_one(self, said: _Utterance) -> None:
        try:
            reading = self._ears.hear(said.sound)
        except Exception as error:  # ears of others must not end the thread
            log.warning("%s failed: %r", self._ears.name, error)
            reading = Reading(self._ears.name, "", problem="the ears failed")
        if said.turn == self._turn:
            self._doubt.hear(reading, said.overlap, said.began)
