"""The two seams of speech: who hears, and who speaks. Both are called from threads of their own."""

from dataclasses import dataclass
from typing import Protocol

from executive.speech.sound import Sound


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """What a person in this home speaks of, in lower case: ears may listen for these words."""

    things: tuple[str, ...] = ()
    places: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Reading:
    """What ears made of an utterance.

    Attributes:
        by: the ears' name.
        text: the words; empty if they could not make any of it.
        confidence: between 0 and 1; 0 if the ears cannot tell.
        sure: whether the words may be acted upon without asking; ours are only of a yes or a no.
        problem: why the ears could not hear it, as a clause; empty if they could.
    """

    by: str
    text: str
    confidence: float = 0.0
    sure: bool = False
    problem: str = ""


class Ears(Protocol):
    """Makes words of what a person said."""

    @property
    def name(self) -> str:
        """Who hears, in a word, for logs."""
        ...

    def hear(self, sound: Sound) -> Reading:
        """What was said in one utterance; takes as long as it takes. Never raises.

        One thread calls it, which is neither the one that ticks nor the one that listens to a stop.
        What is silence or noise has no text. What is not certain is not `sure`: a wrong reading
        that is sure becomes a wrong deed.
        """
        ...

    def close(self) -> None:
        """Free what was opened."""
        ...


class Voice(Protocol):
    """Says aloud what the robot says."""

    def say(self, text: str) -> None:
        """Say it after what is being said; returns at once. Never raises."""
        ...

    def hush(self) -> None:
        """Be silent at once, and forget what was to be said."""
        ...

    @property
    def saying(self) -> str:
        """What is being said or is about to be, as it sounds, for ears hear it, too; or nothing."""
        ...

    def close(self) -> None:
        """Be silent for good."""
        ...
