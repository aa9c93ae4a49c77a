"""Parses a server's transcript in OpenAI's format, and cleans a model's text."""

import json
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from executive.servers.refusal import refusal_in
from executive.text import one_line, writable

MOST_CHARACTERS = 400
"""The longest text of an utterance; a longer one is dropped: on noise, models repeat themselves."""
NO_SPEECH, HARDLY = 0.6, -1.0
"""A segment with a higher probability of no speech, and a lower mean log-probability of its words,
is not speech: the rule of Whisper itself."""
_ANNOTATION = re.compile(r"\[[^\]]*\]|\([^)]*\)|\*[^*]*\*|♪")
"""Annotations, which nobody said: [BLANK_AUDIO], (music), *coughs*."""


class NotATranscript(Exception):
    """The reply is not a transcript, not even an empty one."""


@dataclass(frozen=True, slots=True)
class Transcript:
    """The words, and their confidence in [0, 1]; 0 if the server gives none."""

    text: str
    confidence: float = 0.0


def transcript(body: bytes) -> Transcript:
    """Parse the body of a reply.

    Raises:
        NotATranscript: if it is something else; says what.
        Refused: if it contains an error in spite of a good status.
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
    """The words in a model's text, on one line; empty if there are none, or too many."""
    words = one_line(_ANNOTATION.sub(" ", writable(text[: 4 * MOST_CHARACTERS])))
    spoken = any(map(str.isalnum, words)) and len(words) <= MOST_CHARACTERS
    return words if spoken else ""


def _pieces(segments: object) -> Iterator[tuple[float, float]]:
    """For each segment, the mean log-probability of its words, and the probability of no speech."""
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
