"""The contract of all Ears. An adapter's tests subclass `EarsContract`.

Provide a fixture `ears` that yields them.
"""

import numpy as np
import pytest

from executive.speech.interfaces import Ears
from executive.speech.sound import RATE_HZ, Sound

NOISE = np.random.default_rng(0).normal(0, 3000, RATE_HZ).astype(np.int16)
SILENT = np.zeros(RATE_HZ, dtype=np.int16)


class EarsContract:
    """Each method tests one requirement of `executive.speech.interfaces.Ears`."""

    @pytest.mark.parametrize(
        "sound", [SILENT[:0], SILENT[:7], SILENT, NOISE], ids=["empty", "short", "silent", "noise"]
    )
    def test_what_is_no_speech_is_never_sure(self, ears: Ears, sound: Sound) -> None:
        assert not ears.hear(sound).sure

    def test_silence_has_no_words(self, ears: Ears) -> None:
        assert ears.hear(SILENT).text == ""

    def test_it_says_who_heard(self, ears: Ears) -> None:
        assert ears.name
        assert ears.hear(SILENT).by == ears.name

    def test_confidence_is_a_part_of_one(self, ears: Ears) -> None:
        assert 0.0 <= ears.hear(NOISE).confidence <= 1.0
