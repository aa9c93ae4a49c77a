"""Places in words that no grammar reads, by the preposition before them: "... from the desk"."""

import re
from collections.abc import Callable, Iterator

from executive.language.phrases import PREPOSITIONS

MOST_WORDS = 5
"""Of a place, as in "bookshelf in the bedroom"."""
_GOAL = r"(?:over\s+)?(?:to|into|onto)"
_SOURCE = r"(?:from|in|on|at|inside|off|by)"
_PLACE = re.compile(rf"\b({_GOAL}|{_SOURCE})\s+(?:(?:the|a|an|my|our|your)\s+)?(?=\w)", re.I)
_WORD = re.compile(r"[\w'’-]+")


def placed(words: str, is_place: Callable[[str], bool]) -> tuple[str, str]:
    """Where something is, and where it is to go, as it was said; empty if the words do not say.

    Args:
        words: what was said.
        is_place: whether words are the name of a place, and nothing else.
    """
    found = {"source": "", "goal": ""}
    for preposition, place in _places(words, is_place):
        role = "goal" if re.fullmatch(_GOAL, preposition, re.I) else "source"
        found[role] = found[role] or place
    return found["source"], found["goal"]


def _places(words: str, is_place: Callable[[str], bool]) -> Iterator[tuple[str, str]]:
    """Each preposition with the longest place behind it; what is in a place is not one more."""
    end = 0
    for match in _PLACE.finditer(words):
        if match.start() < end:
            continue
        ends = [word.end() for word in _WORD.finditer(words, match.end())][:MOST_WORDS]
        for to in reversed(ends):
            place = words[match.end() : to]
            last = place.rpartition(" ")[2].lower()
            if last not in PREPOSITIONS and is_place(place):
                yield match[1], place
                end = to
                break
