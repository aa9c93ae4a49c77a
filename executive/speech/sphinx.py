"""Ears with a packaged model: pocketsphinx, with a grammar for this home.

A grammar matches every sound to one of its sentences, also if something else was said. So an
utterance is decoded three times: with the grammar; with the same grammar and many words more, which
have no meaning in this home; and with phones only. If a word fits its sounds much worse than the
phones do, the confidence is low. If it is low, or the first two readings differ, the reading is not
sure. In our measurements, one in fourteen readings that passed both tests was still wrong, so that
only a yes or a no is ever `sure`.
"""

import logging
import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from executive.errors import InputError
from executive.speech.interfaces import Reading, Vocabulary
from executive.speech.jsgf import LITTLE, grammar, words_of_template
from executive.speech.sound import RATE_HZ, Sound, is_silent, with_floor

if TYPE_CHECKING:
    from pocketsphinx import Decoder

NAME = "pocketsphinx"
MISSING = "pip install 'robot-executive[speech]'"
WORST = -10.0
"""A word that fits worse than the phones by this, in the decoder's units per frame, has a
confidence of 0."""
SLACK = 3.0
"""How much worse function words may fit (same units): they are short and spoken carelessly."""
SURE = 0.6
"""Confidence from which a yes or a no is sure (tests/benchmarks/bench_speech.py --part dev)."""
YES_OR_NO = frozenset(("yes", "yes please", "no", "okay"))
LEAST = 0.3
"""Below this confidence, a reading is not worth a question: its text is left out."""
MOST_SWALLOWED = 6
"""Frames (of 10 ms) of speech allowed in a silence: the beginning or the end of a sound."""
LOUD = 0.1
"""A frame above this share of the loudest frame's level is speech."""
_FRAME = RATE_HZ // 100
_BEAMS = {"beam": 1e-64, "wbeam": 1e-50, "pbeam": 1e-64}
"""Wider than pocketsphinx's default: a sentence that is pruned is not found again."""
_TINY = 1e-300
_VARIANT = re.compile(r"\(\d+\)$")
log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Segment:
    """A word, a noise or a phone, with its frames (`last` included) and its log-likelihood there.

    The log-likelihood `score` is in the decoder's units.
    """

    word: str
    first: int
    last: int
    score: float

    @property
    def frames(self) -> slice:
        """Its frames as a slice."""
        return slice(self.first, self.last + 1)

    @property
    def is_word(self) -> bool:
        """Whether it is neither a silence nor a noise."""
        return self.word[0] not in "<[+("


class PocketsphinxEars:
    """Implements `Ears`."""

    name = NAME

    def __init__(self, vocabulary: Vocabulary) -> None:
        """Load the packaged model, with a grammar for this vocabulary.

        Raises:
            InputError: if pocketsphinx is not installed.
        """
        self._words = decoder(**_BEAMS)
        for word in words_of_template():
            self._can_pronounce(word)
        own, unheard = grammar(vocabulary, self._can_pronounce)
        wide, _ = grammar(vocabulary, self._can_pronounce, others=True)
        for name in unheard:
            log.warning("%s does not know how '%s' sounds: it has to be typed", NAME, name)
        self._words.add_jsgf_string("home", own)
        self._words.add_jsgf_string("wide", wide)
        self._phones = decoder(allphone_ci=True, lw=2.0, pip=0.3, beam=1e-20, pbeam=1e-20)
        self._phones.add_allphone_file("phones", model("en-us-phone.lm.bin"))

    def hear(self, sound: Sound) -> Reading:
        """Decode the utterance three times."""
        if is_silent(sound):
            return Reading(self.name, "")
        sound = with_floor(sound)
        try:
            own = segments(self._words, "home", sound)
            wide = segments(self._words, "wide", sound)
            phones = segments(self._phones, "phones", sound)
        except RuntimeError as error:
            log.warning("%s failed: %s", NAME, error)
            return Reading(self.name, "")
        confidence = round(certainty(own, phones, sound), 3)
        agreed = telling(own) == telling(wide)
        text = words_of(own) if confidence >= LEAST else ""
        sure = agreed and confidence >= SURE and text in YES_OR_NO
        return Reading(self.name, text, confidence, sure=sure)

    def close(self) -> None:
        """Do nothing: no resource stays open."""

    def _can_pronounce(self, word: str) -> bool:
        """Whether a pronunciation is known; that of a compound is made from its two words."""
        if self._words.lookup_word(word):
            return True
        for cut in range(len(word) - 3, 2, -1):
            parts = [self._words.lookup_word(part) for part in (word[:cut], word[cut:])]
            if all(parts):
                self._words.add_word(word, " ".join(parts), True)
                return True
        return False


def words_of(segments: list[Segment]) -> str:
    """The recognised words."""
    return " ".join(_plain(one) for one in segments if one.is_word)


def telling(segments: list[Segment]) -> tuple[str, ...]:
    """The words without function words."""
    return tuple(_plain(one) for one in segments if one.is_word and _plain(one) not in LITTLE)


def certainty(words: list[Segment], phones: list[Segment], sound: Sound) -> float:
    """Confidence in [0, 1], by the word that fits its sounds worst; noise counts as a word."""
    spoken = [one for one in words if one.word != SILENCE]
    if not spoken or _is_swallowed(words, sound):
        return 0.0
    by_sound = _per_frame(phones, 1 + max(one.last for one in (*words, *phones)))
    worst = min(_fit(one, by_sound) for one in spoken)
    return float(np.clip(1.0 - worst / WORST, 0.0, 1.0))


SILENCE = "<sil>"


def _plain(one: Segment) -> str:
    return _VARIANT.sub("", one.word)


def _fit(one: Segment, by_sound: NDArray[np.float64]) -> float:
    """How much better than the phones a word fits, per frame; mostly negative."""
    sounds = by_sound[one.frames]
    slack = SLACK if _plain(one) in LITTLE else 0.0
    return (one.score - float(sounds.sum())) / len(sounds) + slack


def _per_frame(phones: list[Segment], frames: int) -> NDArray[np.float64]:
    """(frames,) the score of the phones in each frame."""
    scores = np.zeros(frames)
    for one in phones:
        scores[one.frames] = one.score / (one.last - one.first + 1)
    return scores


def _is_swallowed(words: list[Segment], sound: Sound) -> bool:
    """Whether speech was decoded as silence, so that no word covers it."""
    frames = sound[: len(sound) // _FRAME * _FRAME].reshape(-1, _FRAME).astype(np.float64)
    power = np.sqrt((frames**2).mean(axis=1))
    loud = power > LOUD * power.max(initial=0.0)
    silences = (one for one in words if one.word == SILENCE)
    return any(int(loud[one.frames].sum()) > MOST_SWALLOWED for one in silences)


def decoder(**settings: Any) -> "Decoder":
    """A decoder with the packaged acoustic model and dictionary, without a search yet.

    Raises:
        InputError: if pocketsphinx is not installed.
    """
    try:
        from pocketsphinx import Decoder  # of the extra `speech`
    except ImportError:
        raise InputError("pocketsphinx", "it is not installed", MISSING) from None
    given = {"cmn": "batch", "bestpath": False, "lm": None, "loglevel": "FATAL", **settings}
    return Decoder(hmm=model("en-us"), dict=model("cmudict-en-us.dict"), **given)


def model(name: str) -> str:
    """The path of a file of the packaged model."""
    from pocketsphinx import get_model_path

    return str(get_model_path(f"en-us/{name}"))


def segments(decoder: "Decoder", search: str, sound: Sound) -> list[Segment]:
    """Decode an utterance into segments; empty if it does not fit the search."""
    decoder.activate_search(search)
    decoder.start_utt()
    decoder.process_raw(sound.astype("<i2").tobytes(), full_utt=True)
    decoder.end_utt()
    if decoder.hyp() is None:
        return []
    every = (
        Segment(one.word, one.start_frame, one.end_frame, math.log(max(one.ascore, _TINY)) * 1000)
        for one in decoder.seg()
    )
    return [one for one in every if one.word != "(NULL)" and one.last >= one.first]
