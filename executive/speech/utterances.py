"""Splits a stream of sound into utterances, by loudness."""

from collections import deque

import numpy as np

from executive.speech.sound import RATE_HZ, Sound

OVER_NOISE = 4.0
"""Speech is louder than the background, the sound between utterances, by this factor."""
LEAST = 150.0
"""Level (root mean square) below which nothing is speech, however quiet it is otherwise."""
BEFORE_S, PAUSE_S = 0.3, 0.7
"""How much sound (s) is kept from before an utterance, and how much quiet ends it."""
SHORTEST_S = 0.15
"""A sound that is loud for less than this (s) is a click."""
MOST_S = 15.0
"""Longer utterances (s) are noise, not commands, and are dropped."""


class Utterances:
    """Cuts blocks of sound into utterances."""

    def __init__(self) -> None:
        """Begin without sound."""
        self._noise = LEAST / OVER_NOISE
        self.level = 0.0
        """Level (root mean square) of the last block."""
        self.too_long = False
        """Whether the utterance that ended with the last block was too long for a command."""
        self.is_loud = False
        """Whether the last block was as loud as speech."""
        self._before: deque[Sound] = deque()
        self._spoken: list[Sound] = []
        self._loud_s = self._quiet_s = 0.0

    def add(self, block: Sound) -> Sound | None:
        """Add a block; return the utterance that ends with it, or None."""
        level = float(np.sqrt(np.mean(block.astype(np.float64) ** 2))) if len(block) else 0.0
        self.level, self.too_long = level, False
        seconds = len(block) / RATE_HZ
        self.is_loud = loud = level > max(LEAST, OVER_NOISE * self._noise)
        if not self._spoken and not loud:
            self._noise += 0.1 * (level - self._noise)
            self._before.append(block)
            while sum(map(len, self._before)) > BEFORE_S * RATE_HZ:
                self._before.popleft()
            return None
        if not self._spoken:
            self._spoken, self._before = list(self._before), deque()
        self._spoken.append(block)
        self._loud_s += seconds * loud
        self._quiet_s = 0.0 if loud else self._quiet_s + seconds
        return self.end() if self._quiet_s >= PAUSE_S or self._length_s > MOST_S else None

    def end(self) -> Sound | None:
        """End the utterance and return it; None if there is none, or it is a click or too long."""
        whole, said = self._spoken, self._loud_s >= SHORTEST_S and self._length_s <= MOST_S
        self.too_long = self._length_s > MOST_S
        if self.too_long:
            self._noise = self.level  # a constant level is background noise
        self._spoken, self._loud_s, self._quiet_s = [], 0.0, 0.0
        return np.concatenate(whole) if said and whole else None

    @property
    def is_open(self) -> bool:
        """Whether an utterance has begun."""
        return bool(self._spoken)

    @property
    def _length_s(self) -> float:
        return sum(map(len, self._spoken)) / RATE_HZ
