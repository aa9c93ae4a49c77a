"""Listens all the time, on a thread of its own: for a stop while something runs, and for words."""

import threading
from collections.abc import Iterator

from executive.errors import ExecutiveError
from executive.speech.doubt import Doubt
from executive.speech.hearing import Hearing
from executive.speech.interfaces import Ears, Voice
from executive.speech.interrupting import Interrupting
from executive.speech.overlap import Overlapping
from executive.speech.sound import RATE_HZ, Sound
from executive.speech.spotting import StopSpotter
from executive.speech.utterances import Utterances
from executive.text import printable
from executive.user import Console

DEAD_S = 10.0
"""A microphone that gives only zeros for this long (s) is switched off."""
DEAD = "I hear nothing at all, not even noise. Is the microphone switched off?"

TOO_LONG = "What I hear is too long for a command, or noise."
NOBODY = "The sound has ended, and I have heard nobody speak."


class Listening:
    """Passes sound from the microphone to the stop spotter and, by utterances, to the ears.

    The spotter is used while there is something to stop: the robot's action, or its voice.
    """

    def __init__(
        self,
        blocks: Iterator[Sound],
        ears: Ears,
        doubt: Doubt,
        person: Console,
        *,
        spotter: StopSpotter | None = None,
        voice: Voice | None = None,
        live: bool = True,
    ) -> None:
        """Connect the parts; `start` begins.

        If the sound is not `live`, listening waits until each utterance is recognised.
        """
        self._blocks = blocks
        self._doubt = doubt
        self._person = person
        self._spotter = spotter
        self._voice = voice
        self._live = live
        self._closed = False
        self._hearing = Hearing(ears, doubt)
        self._interrupting = Interrupting()
        self._dead_s = 0.0
        self._understands = True
        """Whether the last utterance could be a command; if not, the person was told already."""
        self._heard = False
        """Whether there was any utterance."""
        self._thread = threading.Thread(target=self._listen, name="ears", daemon=True)

    def start(self) -> None:
        """Start the thread; it ends with the sound."""
        self._person.keep_open(True)
        self._thread.start()

    def close(self) -> None:
        """Stop listening, and drop utterances that are not recognised yet."""
        self._closed = True
        self._hearing.forget()

    def _listen(self) -> None:
        try:
            self._listen_to_all()
            if not (self._heard or self._closed):
                self._person.mention(NOBODY)
        except (ExecutiveError, OSError, ValueError) as error:
            if not self._closed:
                self._person.mention(f"I hear no more: {printable(error)}.")
        finally:
            self._hearing.finish()
            self._person.keep_open(False)

    def _listen_to_all(self) -> None:
        cut, overlapping = Utterances(), Overlapping()
        for block in self._blocks:
            if self._closed:
                return
            saying = self._voice.saying if self._voice else ""
            if self._hears_stop(block, saying):
                cut, overlapping = Utterances(), Overlapping()
                continue
            self._warn_if_dead(block)
            said, seconds = cut.add(block), len(block) / RATE_HZ
            overlapping.add(saying, seconds, loud=cut.is_loud)
            if self._interrupting.add(cut.level, seconds, speaking=bool(saying)):
                self._give_way(overlapping)
            if said is not None:
                self._add(said, overlapping)
            elif not cut.is_open:
                overlapping.take()
            if cut.too_long and self._understands:
                self._understands = False
                self._person.mention(TOO_LONG)
        if (said := cut.end()) is not None:
            self._add(said, overlapping)

    def _add(self, said: Sound, overlapping: Overlapping) -> None:
        self._heard = self._understands = True
        self._hearing.add(said, overlapping.take())
        if not self._live:
            self._hearing.settle()

    def _hears_stop(self, block: Sound, saying: str) -> bool:
        """Whether a spoken stop ends in this block; if so, stop the robot and its voice."""
        busy = self._person.is_busy
        if not self._spotter or not (busy or saying) or not self._spotter.hears_stop(block):
            return False
        self._hearing.forget()
        if self._voice:
            self._voice.hush()
        self._doubt.stop(busy=busy)
        return True

    def _give_way(self, overlapping: Overlapping) -> None:
        """Stop speaking, as somebody interrupts."""
        overlapping.interrupted()
        if self._voice:
            self._voice.hush()

    def _warn_if_dead(self, block: Sound) -> None:
        """Tell the person, once, if the microphone seems to be switched off."""
        before = self._dead_s
        self._dead_s = 0.0 if block.any() else before + len(block) / RATE_HZ
        if before < DEAD_S <= self._dead_s:
            self._person.mention(DEAD)
