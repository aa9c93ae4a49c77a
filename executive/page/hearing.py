"""What a browser's recogniser heard: read from what a page sent, and made of it what ears make."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from executive.language.control import Control, control
from executive.speech.interfaces import Reading
from executive.text import LONGEST, one_line, writable

BROWSER = "browser"
"""Who hears, in logs."""
MOST_ALTERNATIVES = 5
CERTAIN = 0.8
"""From this confidence on, a yes is one. It is not tuned: browsers differ in what they mean by it,
and one that cannot tell says 0."""


class Alternative(NamedTuple):
    """What may have been said, and how surely; 0 if the recogniser cannot tell."""

    words: str
    confidence: float


def alternatives_in(sent: Mapping[str, Any]) -> tuple[Alternative, ...]:
    """What a page sent, the likeliest first; none if it is too long, or something else."""
    given = sent.get("alternatives")
    if not isinstance(given, list) or len(given) > MOST_ALTERNATIVES:
        return ()
    read = tuple(map(_alternative, given))
    return () if None in read else tuple(filter(None, read))


def _alternative(given: object) -> Alternative | None:
    match given:
        case {"words": str(words), "confidence": int() | float() as confidence} if (
            len(words) <= LONGEST and 0 <= confidence <= 1
        ):
            return Alternative(one_line(writable(words)), float(confidence))
    return None


def stop_in(heard: Iterable[Alternative]) -> Alternative | None:
    """One that says stop; None if none of them does."""
    return next((one for one in heard if control(one.words) is Control.STOP), None)


class Hearing:
    """Chooses among alternatives, as one who knows this home and how one says yes."""

    def __init__(self, names: Iterable[str], agrees: Callable[[str], bool | None]) -> None:
        """Know these names of things and places, in lower case."""
        self._names = tuple(f" {name} " for name in names)
        self._agrees = agrees

    def reading(self, heard: Sequence[Alternative]) -> Reading:
        """The likeliest that speaks of what there is, or says yes or no; else the likeliest.

        Only a yes or a no is ever certain, if the recogniser thinks so and no alternative says
        anything else.
        """
        best = max(heard, key=self._makes_sense)
        said = {self._agrees(one.words) for one in heard}
        sure = best.confidence >= CERTAIN and len(said) == 1 and None not in said
        return Reading(BROWSER, best.words, best.confidence, sure)

    def _makes_sense(self, one: Alternative) -> bool:
        plain = f" {' '.join(re.findall(r'[a-z0-9]+', one.words.lower()))} "
        return self._agrees(one.words) is not None or any(name in plain for name in self._names)
