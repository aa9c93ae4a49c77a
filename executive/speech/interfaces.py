"""The two interfaces of speech: recognition and output."""

from dataclasses import dataclass
from typing import Protocol

from executive.speech.sound import Sound


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """Names of things and places in this home, in lower case, as hints for the ears."""

    things: tuple[str, ...] = ()
    places: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Reading:
    """The result of recognising one utterance.

    Attributes:
        by: name of the ears.
        text: the words; empty if none were recognised.
        confidence: in [0, 1]; 0 if the ears give none.
        sure: whether to act on the words without asking; ours are only sure of a yes or a no.
        problem: why recognition failed, as a clause; empty if it did not.
    """

    by: str
    text: str
    confidence: float = 0.0
    sure: bool = False
    problem: str = ""


class Ears(Protocol):
    """A speech recogniser."""

    @property
    def name(self) -> str:
        """Name for the logs, one word."""
        ...

    def hear(self, sound: Sound) -> Reading:
        """Recognise one utterance; may block. Never raises.

        It is called from one thread, which is neither the ticking one nor the one that listens for
        a stop. Silence and noise have no text. Set `sure` only if it is certain: a wrong reading
        that is sure becomes a wrong action.
        """
        ...

    def close(self) -> None:
        """Free all resources."""
        ...


class Voice(Protocol):
    """Says aloud what the robot says. Any thread may call it."""

    def say(self, text: str) -> None:
        """Queue a sentence; returns at once. Never raises."""
        ...

    def hush(self) -> None:
        """Stop speaking at once, and clear the queue."""
        ...

    @property
    def saying(self) -> str:
        """The current and waiting sentences as they sound, since the ears hear them; or empty."""
        ...

    def close(self) -> None:
        """Stop speaking, and free all resources."""
        ...
