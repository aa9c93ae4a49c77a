"""Listens all the time, on a thread of its own: to a stop while something runs, and to words."""

import logging
import threading
from collections.abc import Iterator

from executive.errors import ExecutiveError
from executive.speech.doubt import Doubt
from executive.speech.interfaces import Ears, Voice
from executive.speech.sound import Sound
from executive.speech.spotting import StopSpotter
from executive.speech.utterances import Utterances
from executive.user import Console

log = logging.getLogger(__name__)


class Listening:
    """What the microphone hears goes to the ears, and what they make of it to the person's side."""

    def __init__(
        self,
        blocks: Iterator[Sound],
        ears: Ears,
        doubt: Doubt,
        person: Console,
        *,
        spotter: StopSpotter | None = None,
        voice: Voice | None = None,
    ) -> None:
        """Put it together; `start` begins."""
        self._blocks = blocks
        self._ears = ears
        self._doubt = doubt
        self._person = person
        self._spotter = spotter
        self._voice = voice
        self._closed = False
        self._thread = threading.Thread(target=self._listen, name="ears", daemon=True)

    def start(self) -> None:
        """Listen from now on, until the sound ends."""
        self._person.keep_open(True)
        self._thread.start()

    def close(self) -> None:
        """Listen no more; what is being heard is dropped."""
        self._closed = True

    def _listen(self) -> None:
        try:
            self._listen_to_all()
        except (ExecutiveError, OSError, ValueError) as error:
            log.warning("the ears hear no more: %s", error)
        finally:
            self._person.keep_open(False)

    def _listen_to_all(self) -> None:
        cut = Utterances()
        own = False
        for block in self._blocks:
            if self._closed:
                return
            if self._spotter and self._person.is_busy and self._spotter.hears_stop(block):
                self._stop()
                cut, own = Utterances(), False
                continue
            own = own or bool(self._voice and self._voice.speaks)
            said = cut.add(block)
            if said is not None:
                self._hear(said, own)
            if said is not None or not cut.is_open:
                own = False
        if (said := cut.end()) is not None:
            self._hear(said, own)

    def _hear(self, sound: Sound, own: bool) -> None:
        """What was said while the robot spoke is mostly the robot: it is left out."""
        if not own:
            self._doubt.hear(self._ears.hear(sound))

    def _stop(self) -> None:
        if self._voice:
            self._voice.hush()
        self._doubt.stop()
