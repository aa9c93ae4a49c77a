"""What one asks for and corrects in the same breath: "bring me the apple, no, the pear"."""

import re
from collections.abc import Callable

from executive.language.anew import asked_anew
from executive.language.meaning import Correction, Request, Said, Things
from executive.language.pronouns import with_names
from executive.language.spoken import Spoken

MOST = 4
"""Corrections in one sentence; nobody says more."""


def corrected_in_one_breath(
    text: str, turn: re.Pattern[str], read: Callable[[str], Said]
) -> Request | None:
    """What is meant in the end; None if it is not a request that is corrected.

    Args:
        text: in plain form; as it is, nobody can read it.
        turn: the words with which one corrects oneself.
        read: reads words in plain form.
    """
    first, *others = turn.split(text, MOST)
    said = read(first.strip(", ")) if others else None
    for words in others:
        correction = read(f"no, {words.strip(', ')}")
        if not isinstance(said, Request) or not isinstance(correction, Correction):
            return None
        things = said.tasks[-1].things
        members = things.members if things else ()
        if len(members) > 1 and isinstance(correction.meant, Things):
            return None  # "the mug and the apple, no, the pear": who knows whether in place of both
        spoken = Spoken(tuple(thing.words for thing in members if thing.words), request=said)
        said = asked_anew(with_names(correction, spoken), spoken, in_one_breath=True)
    return said if isinstance(said, Request) else None
