"""What a model writes of what it heard, and a server's reply as OpenAI has it."""

import json
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from executive.servers.refusal import refusal_in
from executive.text import one_line, writable

MOST_CHARACTERS = 400
"""Nobody says more in the seconds that an utterance may have: models repeat themselves in noise."""
NO_SPEECH, HARDLY = 0.6, -1.0
"""A piece that is likelier no speech than this, and whose words are hardly likely, is none: as
Whisper itself has it."""
_ASIDE = re.compile(r"\[[^\]]*\]|\([^)]*\)|\*[^*]*\*|♪")
"""What no one said: [BLANK_AUDIO], (music), *coughs*."""


class NotATranscript(Exception):
    """The reply has no words in it, nor does it say that there were none."""


@dataclass(frozen=True, slots=True)
class Transcript:
    """What was said, and how likely that is: 0 to 1, and 0 if the server does not tell."""

    text: str
    confidence: float = 0.0


def transcript(body: bytes) -> Transcript:
    """Read it.

    Raises:
        NotATranscript: says what it is instead.
        Refused: if it says that something was wrong, although its status was good.
    """
    try:
        value: object = json.loads(body.decode(errors="replace"))
    except (ValueError, RecursionError):
        raise NotATranscript("it is not JSON") from None
    if not isinstance(value, dict):
        raise NotATranscript("it is no JSON object")
    if refused := refusal_in(value):
        raise refused
    text = value.get("text")
    if not isinstance(text, str):
        raise NotATranscript("it has no 'text'")
    pieces = list(_pieces(value.get("segments")))
    if pieces and all(silent > NO_SPEECH and likely < HARDLY for likely, silent in pieces):
        return Transcript("")
    likely = min((likely for likely, _ in pieces), default=-math.inf)
    return Transcript(said(text), round(min(1.0, math.exp(min(likely, 0.0))), 3))


def said(text: str) -> str:
    """The words in what a model wrote, in a line; empty if there are none, or too many."""
    words = one_line(_ASIDE.sub(" ", writable(text[: 4 * MOST_CHARACTERS])))
    spoken = any(map(str.isalnum, words)) and len(words) <= MOST_CHARACTERS
    return words if spoken else ""


def _pieces(segments: object) -> Iterator[tuple[float, float]]:
    """Of each piece the mean logarithm of its words' likelihood, and that it is no speech."""
    for one in segments if isinstance(segments, list) else []:
        if isinstance(one, dict):
            likely = _number(one.get("avg_logprob"))
            if likely is not None:
                yield likely, _number(one.get("no_speech_prob")) or 0.0


def _number(value: object) -> float | None:
    """A finite number; None for anything else."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None
