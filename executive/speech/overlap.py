"""Finds the robot's own voice in an utterance, by when it spoke and when there was other sound."""

from dataclasses import dataclass

TAIL_S = 0.5
"""How long (s) a room reverberates after the robot has spoken."""
LEAST_S = 0.3
"""Sound before or after the robot's words that is loud for less than this (s) is not speech."""


@dataclass(frozen=True, slots=True)
class Overlap:
    """The robot's own words during an utterance.

    Attributes:
        own: what the robot said; empty if it was silent.
        beside: whether somebody else spoke, too: before the robot began, after it had ended, or
            louder than it; False if the robot was silent.
    """

    own: str = ""
    beside: bool = False


NONE = Overlap()


class Overlapping:
    """Collects what the robot says during an utterance."""

    def __init__(self) -> None:
        """Begin with the first utterance."""
        self._said: list[str] = []
        self._interrupted = False
        self._tail_s = 0.0
        self._beside_s = 0.0

    def add(self, saying: str, seconds: float, *, loud: bool) -> None:
        """Add a block.

        Args:
            saying: what the robot said meanwhile; empty if it was silent.
            seconds: duration of the block.
            loud: whether it is as loud as speech.
        """
        if saying:
            self._tail_s = TAIL_S
            if not self._said or self._said[-1] != saying:
                self._said.append(saying)
        elif self._tail_s > 0:
            self._tail_s -= seconds
        elif loud:
            self._beside_s += seconds

    def interrupted(self) -> None:
        """Note that somebody else spoke over the robot."""
        self._interrupted = True

    def take(self) -> Overlap:
        """Return the overlap of the utterance that has ended, and begin the next one."""
        beside = self._interrupted or self._beside_s >= LEAST_S
        found = Overlap(" ".join(self._said), bool(self._said) and beside)
        self._said, self._beside_s, self._interrupted = [], 0.0, False
        return found
