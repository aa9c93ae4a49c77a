"""What an utterance has in it of the robot's own voice, by when it was loud and when it spoke."""

from dataclasses import dataclass

TAIL_S = 0.5
"""So long a room still sounds of what was said."""
LEAST_S = 0.3
"""What is loud for less beside the robot's own words is no word of a person."""


@dataclass(frozen=True, slots=True)
class Overlap:
    """What the robot said during an utterance.

    Attributes:
        own: its words; empty if it was silent.
        beside: whether somebody else spoke as well: before it began, after it had ended, or louder.
    """

    own: str = ""
    beside: bool = False


NONE = Overlap()


class Overlapping:
    """Follows what the robot says while an utterance is heard."""

    def __init__(self) -> None:
        """Nothing was heard yet."""
        self._said: list[str] = []
        self._interrupted = False
        self._tail_s = 0.0
        self._beside_s = 0.0

    def add(self, saying: str, seconds: float, *, loud: bool) -> None:
        """So long the robot said this, and it was loud or not."""
        if saying:
            self._tail_s = TAIL_S
            if not self._said or self._said[-1] != saying:
                self._said.append(saying)
        elif self._tail_s > 0:
            self._tail_s -= seconds
        elif loud:
            self._beside_s += seconds

    def interrupted(self) -> None:
        """Somebody else spoke into the robot's words."""
        self._interrupted = True

    def take(self) -> Overlap:
        """What it was of the utterance that has ended; the next one begins."""
        beside = self._interrupted or self._beside_s >= LEAST_S
        found = Overlap(" ".join(self._said), bool(self._said) and beside)
        self._said, self._beside_s, self._interrupted = [], 0.0, False
        return found
