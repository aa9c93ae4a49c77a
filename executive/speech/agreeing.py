"""Accepts a spoken yes as sure if a second, independent recogniser hears it, too.

The confidence of another recogniser has a scale of its own, for which we have not measured where a
wrong yes begins. For the local one we have.
"""

from collections.abc import Callable
from dataclasses import replace

from executive.speech.interfaces import Ears, Reading
from executive.speech.sound import Sound


class Agreeing:
    """Implements `Ears` with the words of `first`; only a yes or a no is ever sure.

    It is sure if `second` is sure of the same answer.
    """

    def __init__(self, first: Ears, second: Ears, agrees: Callable[[str], bool | None]) -> None:
        """`agrees` tells whether words are a yes, a no (False), or neither (None)."""
        self._first = first
        self._second = second
        self._agrees = agrees

    @property
    def name(self) -> str:
        """The name of `first`."""
        return self._first.name

    def hear(self, sound: Sound) -> Reading:
        """Recognise speech; use `second` only for a yes or a no."""
        reading = self._first.hear(sound)
        answer = self._agrees(reading.text) if reading.text else None
        if answer is None:
            return replace(reading, sure=False)
        second = self._second.hear(sound)
        same = second.sure and self._agrees(second.text) == answer
        return replace(reading, sure=same)

    def close(self) -> None:
        """Close both."""
        self._first.close()
        self._second.close()
