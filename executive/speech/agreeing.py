"""A yes is certain where ears of two kinds, which know nothing of each other, hear it.

How certain other ears are is in a measure of their own, of which nobody here has tried where a
wrong yes begins. That of the local ones has been tried.
"""

from collections.abc import Callable
from dataclasses import replace

from executive.speech.interfaces import Ears, Reading
from executive.speech.sound import Sound


class Agreeing:
    """Implements `Ears`: the words of the first; a yes or a no is sure if the second's is."""

    def __init__(self, first: Ears, second: Ears, agrees: Callable[[str], bool | None]) -> None:
        """`agrees` tells whether words are a yes, a no (False), or neither (None)."""
        self._first = first
        self._second = second
        self._agrees = agrees

    @property
    def name(self) -> str:
        """The first's."""
        return self._first.name

    def hear(self, sound: Sound) -> Reading:
        """Ask the second only about an answer."""
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
