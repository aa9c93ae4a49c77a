"""What is said beside a request, and asks for nothing: "I am cold. Bring me the tea."."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

from executive.language.meaning import (
    Answer,
    Choice,
    Courtesy,
    Request,
    Said,
    Statement,
    Task,
    Things,
    Unread,
    Where,
)
from executive.language.pronouns import resolved
from executive.language.spoken import Spoken

MOST = 3
"""Sentences beside one request; nobody says more in one breath."""


def beside_a_request(
    text: str,
    asides: Sequence[re.Pattern[str]],
    pause: re.Pattern[str],
    read: Callable[[str], Said],
    left: int = MOST,
    *,
    likely: bool = False,
) -> Request | None:
    """The request among several sentences, if all others ask for nothing; None if they may.

    What such a sentence names is "it" in the request; where it says that it is, it is looked for.

    Args:
        text: in plain form; as it is, nobody can read it.
        asides: sentences that ask for nothing; what they name is a group.
        pause: where a sentence may end.
        read: reads words in plain form.
        left: how many other sentences there may be yet.
        likely: whether what is probably meant is enough: what is told may be about another thing.
    """
    if not left or not (parts := pause.split(text, 1))[1:]:
        return None
    first, rest = parts
    said = read(first)
    if isinstance(said, Request):
        beside = _beside(rest, read(rest), asides, read)
        return _with(said, *beside, likely) if beside is not None and not beside[0] else None
    if (beside := _beside(first, said, asides, read)) is None:
        return None
    request = read(rest)
    if isinstance(request, Unread):
        more = beside_a_request(rest, asides, pause, read, left - 1, likely=likely)
        request = more or request
    return _with(request, *beside, likely) if isinstance(request, Request) else None


def _beside(
    text: str, said: Said, asides: Sequence[re.Pattern[str]], read: Callable[[str], Said]
) -> tuple[tuple[str, ...], Where | None] | None:
    """What a sentence names, and where it is; None if it may ask for something."""
    match said:
        case Courtesy() | Answer(choice=Choice.YES, things=None):
            return (), None
        case Statement(things=Things(members=[thing]), where=where, denied=False, more=None) if (
            not thing.pronoun
        ):
            return (thing.words,), where
        case Answer(told=True, where=[where]):
            return (), where
    found = next(filter(None, (aside.fullmatch(text) for aside in asides)), None)
    if found is None:
        return None
    if not (said_of := found.groupdict().get("thing")):
        return (), None
    match read(f"find {said_of}"):
        case Request(tasks=[Task(things=Things(members=things), source=source)]):
            return tuple(thing.words for thing in things), source
    return None  # "it" would be what was spoken of before


def _with(
    said: Request, names: tuple[str, ...], where: Where | None, likely: bool
) -> Request | None:
    """The request with these names for "it"; None if what was told of is none of what it is about.

    It would be forgotten then, if it is not `likely` enough.
    """
    meant = resolved(said, Spoken(names, " ".join(names)))
    assert isinstance(meant, Request)
    first, *others = meant.tasks
    if where is None:
        return meant
    things = first.things.members if first.things else ()
    is_told_of = bool(things) and (not names or [thing.words for thing in things] == [*names])
    if first.source or not is_told_of:
        return meant if likely else None
    return replace(meant, tasks=(replace(first, source=where), *others))
