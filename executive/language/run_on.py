"""What is said without pauses, or without the "and" between things, as a recogniser writes it."""

import re
from collections.abc import Callable

from executive.language.meaning import Request, Said, Unread
from executive.types.commands import CommandKind

MOST = 8
"""Pauses that are put in, one after the other; nobody says more in one breath."""
_DETERMINED = r"(?:the|a|an|my|our|your|some|two|three|four|five|another|to)\b"
_NEXT = re.compile(rf"{_DETERMINED}(?! (?:(?:\S+ )?ones?|little|bit|lot)\b)")
"""How another thing, or place, may begin; not "the red one", which may be the same."""
_LAST = re.compile(rf"\b{_DETERMINED} (?:(?!\band\b)[^,])+$")
"""How the one before has begun; in "and throw the apple" there is none before."""


def with_pauses(
    text: str, deed: re.Pattern[str], read: Callable[[str], Said], *, likely: bool = False
) -> Request | None:
    """What it asks for with a pause before each deed and thing; None if that is nothing.

    Args:
        text: in plain form; as it is, nobody can read it.
        deed: a word, with a deed behind it for sure: "... bring me", "... go to".
        read: reads words in plain form.
        likely: whether what is probably meant is enough: two things without an "and" may be one, or
            a person who is to have the other.
    """
    paused = deed.sub(r"\1, ", text)
    for put_in in range(MOST):
        said = read(paused)
        if isinstance(said, Request):
            checks = any(t.verb == CommandKind.CHECK and not t.source for t in said.tasks)
            for_sure = put_in != 1 or " and " in text
            return said if (for_sure or likely) and not checks else None
        at = said.begins if isinstance(said, Unread) else -1
        before = paused[: max(at, 0)].rstrip()
        if not (_LAST.search(before) and _NEXT.match(paused, at)):
            return None
        paused = f"{before}, {paused[at:]}"
    return None
