"""Speech for tests: espeak-ng says a sentence."""

import shutil
import subprocess

import numpy as np
import pytest
from patience import PATIENCE_S

from executive.speech.interfaces import Vocabulary
from executive.speech.sound import RATE_HZ, Sound, from_wav

VOICES = ("en-us", "en-gb", "en-us+f3")
QUIET_S = 0.3

needs_espeak = pytest.mark.skipif(
    shutil.which("espeak-ng") is None, reason="needs Debian's espeak-ng"
)


def say(words: str, voice: str = "en-us", words_a_minute: int = 175) -> Sound:
    """The sentence, with a little quiet (noise that can hardly be heard) around it."""
    command = ["espeak-ng", "-v", voice, "-s", str(words_a_minute), "--stdout", words]
    content = subprocess.run(command, check=True, capture_output=True, timeout=PATIENCE_S).stdout
    quiet = np.random.default_rng(0).normal(0, 3, int(QUIET_S * RATE_HZ)).astype(np.int16)
    return np.concatenate([quiet, from_wav(content, words), quiet])


def four_rooms() -> Vocabulary:
    """What is spoken of in the packaged home."""
    from executive.app.building import read_ontology
    from executive.app.speaking import vocabulary
    from executive.config import Settings
    from sim.home.home_file import load_home

    return vocabulary(read_ontology(Settings(), load_home("four_rooms")))
