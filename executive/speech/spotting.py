"""Spots a spoken "stop" at once, while the person still speaks, independently of the ears.

A false stop costs a repeated command; a missed one costs a vase. So the spotter is only used while
there is something to stop, and is tuned to hear rather too many stops than too few.
"""

import tempfile
from pathlib import Path

from executive.speech.sound import RATE_HZ, Sound
from executive.speech.sphinx import decoder

STOP, STOP_TOO = "stop", "stopp"
"""Two keywords, as each has only one pronunciation: the American one, which is in the dictionary,
and `OTHERS_SAY`."""
OTHERS_SAY = "S T AO P"
THRESHOLD = 1e-16
"""Threshold of the keyword: at 1e-8, a third of the spoken stops were missed."""
FORGET_S = 20.0
"""The spotter restarts after this much sound without a stop (s)."""


class StopSpotter:
    """Searches sound for "stop", block by block."""

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
        """Whether a "stop" ended in this block, or shortly before it."""
        self._decoder.process_raw(block.astype("<i2").tobytes())
        self._heard += len(block)
        found = self._decoder.hyp() is not None
        if found or self._heard > FORGET_S * RATE_HZ:
            self._decoder.end_utt()
            self._decoder.start_utt()
            self._heard = 0
        return found
