"""A spoken "stop", heard while the person still speaks, and without the help of any ears.

A false stop costs a command that is said again; a missed one costs a vase. So it is listened for
only while there is something to stop, and then rather too often.
"""

import tempfile
from pathlib import Path

from executive.speech.sound import RATE_HZ, Sound
from executive.speech.sphinx import decoder

STOP, STOP_TOO = "stop", "stopp"
"""As Americans say it, which the dictionary has, and as others do: a keyword has one sound."""
OTHERS_SAY = "S T AO P"
THRESHOLD = 1e-16
"""How likely the word is against any sounds: at 1e-8, a third of the spoken stops were missed."""
FORGET_S = 20.0
"""After so long a stretch of sound, the spotter begins afresh."""


class StopSpotter:
    """Listens to everything, block by block."""

    def __init__(self) -> None:
        """Load the packaged model.

        Raises:
            InputError: if pocketsphinx is not installed.
        """
        self._decoder = decoder(cmn="live")
        self._decoder.add_word(STOP_TOO, OTHERS_SAY, True)
        with tempfile.TemporaryDirectory() as folder:
            keywords = Path(folder) / "stop.txt"
            keywords.write_text("".join(f"{word} /{THRESHOLD}/\n" for word in (STOP, STOP_TOO)))
            self._decoder.add_kws("stop", str(keywords))
        self._decoder.activate_search("stop")
        self._heard = 0
        self._decoder.start_utt()

    def hears_stop(self, block: Sound) -> bool:
        """Whether the word ended in this block, or shortly before it."""
        self._decoder.process_raw(block.astype("<i2").tobytes())
        self._heard += len(block)
        found = self._decoder.hyp() is not None
        if found or self._heard > FORGET_S * RATE_HZ:
            self._decoder.end_utt()
            self._decoder.start_utt()
            self._heard = 0
        return found
