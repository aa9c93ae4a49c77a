"""What one asks for and corrects in the same breath: "bring me the apple, no, the pear"."""

import re
from collections.abc import Callable
from dataclasses import replace

from executive.language.anew import asked_anew
from executive.language.meaning import Answer, Correction, Request, Said, Thing, Things
from executive.language.pronouns import with_names
from executive.language.spoken import Spoken

MOST = 4
"""Corrections in one sentence; nobody says more."""


def corrected_in_one_breath(
    text: str, turn: re.Pattern[str], read: Callable[[str], Said], *, likely: bool = False
) -> Request | None:
    """What is asked for in the end; None if it is not a request that is corrected.

    Args:
        text: in plain form; as it is, nobody can read it.
        turn: the words with which one corrects oneself.
        read: reads words in plain form.
        likely: whether what is probably meant is enough: of several things, the last is corrected.
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
            if not likely:
                return None  # "the mug and the apple, no, the pear": perhaps in place of both
            correction = replace(correction, meant=_in_place_of_last(members, correction.meant))
        spoken = Spoken(tuple(thing.words for thing in members if thing.words), request=said)
        said = asked_anew(with_names(correction, spoken), spoken, in_one_breath=True)
    return said if isinstance(said, Request) else None


def answered_in_one_breath(
    text: str, turn: re.Pattern[str], read: Callable[[str], Said]
) -> Answer | None:
    """The last of several answers, each in place of the one before; None if it is something else.

    As in "the pear, no, the apple", "on the desk, I mean, on the sofa".
    """
    answers = [read(words.strip(", ")) for words in turn.split(text, MOST)]
    *before, last = answers
    names = [bool(a.things or a.where) for a in answers if isinstance(a, Answer)]
    is_corrected = before and len(names) == len(answers) and all(names)
    return last if is_corrected and isinstance(last, Answer) else None


def _in_place_of_last(members: tuple[Thing, ...], meant: Things) -> Things:
    """As many of the things as are named anew, those said last, are not meant.

    Who names some of them again means only these.
    """
    first, *others = meant.members
    kept, wrong = members[: -len(meant.members)], members[-len(meant.members) :]
    if all(thing in members for thing in meant.members):
        kept, wrong = (), tuple(thing for thing in members if thing not in meant.members)
    first = replace(first, exceptions=(*first.exceptions, *wrong))
    return replace(meant, members=(*kept, first, *others))
