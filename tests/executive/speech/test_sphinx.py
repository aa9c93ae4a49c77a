"""Ears that ship with their model; espeak-ng speaks to them."""

import pytest
from speaking import VOICES, four_rooms, needs_espeak, say

from executive.speech.interfaces import Vocabulary
from executive.testing.contracts.ears import EarsContract

pytest.importorskip("pocketsphinx", reason="needs the extra speech")

from executive.speech.sphinx import PocketsphinxEars
from executive.speech.spotting import StopSpotter

RIGHT = ("find the tennis ball", "what is on the bed", "put it on the sideboard")
DENIED = ("do not bring the mug", "don't find the hammer", "nobody should take the pitcher")
UNKNOWN = ("bring the umbrella", "find the elephant", "throw the peach", "open the window")


@pytest.fixture(scope="module")
def ears() -> PocketsphinxEars:
    return PocketsphinxEars(four_rooms())


class TestPocketsphinxEars(EarsContract):
    @pytest.fixture
    def ears(self, ears: PocketsphinxEars) -> PocketsphinxEars:
        return ears


@needs_espeak
@pytest.mark.parametrize("words", RIGHT)
def test_a_command_is_heard_as_it_was_said(ears: PocketsphinxEars, words: str) -> None:
    assert ears.hear(say(words)).text == words


@needs_espeak
@pytest.mark.parametrize("voice", VOICES)
def test_a_yes_is_certain_in_every_voice(ears: PocketsphinxEars, voice: str) -> None:
    reading = ears.hear(say("yes", voice))
    assert (reading.text, reading.sure) == ("yes", True)


@needs_espeak
@pytest.mark.parametrize("words", [*RIGHT, *DENIED, *UNKNOWN])
def test_no_command_is_done_unasked(ears: PocketsphinxEars, words: str) -> None:
    assert not ears.hear(say(words)).sure


@needs_espeak
@pytest.mark.parametrize("voice", VOICES)
@pytest.mark.parametrize("words", ["stop", "please stop"])
def test_a_spoken_stop_is_spotted_while_it_is_spoken(words: str, voice: str) -> None:
    spotter, sound = StopSpotter(), say(words, voice)
    blocks = (sound[at : at + 1600] for at in range(0, len(sound), 1600))
    assert any(spotter.hears_stop(block) for block in blocks)


@needs_espeak
def test_other_words_are_mostly_no_stop() -> None:
    spotter, sound = StopSpotter(), say("bring me the pear")
    assert not spotter.hears_stop(sound)


def test_a_name_of_which_nobody_knows_how_it_sounds_is_left_out(
    caplog: pytest.LogCaptureFixture,
) -> None:
    PocketsphinxEars(Vocabulary(("mug", "xqzzv"), ("desk",)))
    assert "does not know how 'xqzzv' sounds" in caplog.text
