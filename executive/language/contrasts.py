"""Not this, but that: what is to be done in place of what is not to be done."""

import re
from collections.abc import Callable
from dataclasses import replace

from executive.language.meaning import Answer, Refusal, Request, Said, Thing, Things

_TURN = re.compile(r",? but (?:rather |instead )?|, ")


def in_its_place(said: Refusal, read: Callable[[str], Said]) -> Said:
    """What "do not bring the apple, bring the pear" asks for; a refusal, if it asks for nothing.

    What is to be done has to name another thing: "do not take it, bring it" may forbid both.

    Args:
        said: what is not to be done, in the words behind "do not".
        read: reads words in plain form.
    """
    if not (turn := _TURN.search(said.words)):
        return said
    denied, meant = said.words[: turn.start()], read(said.words[turn.end() :])
    wrong = _named(read(denied)) or _named(read(denied.partition(" ")[2]))
    if isinstance(meant, Answer) and "but" in turn[0]:
        meant = _same_deed(read(denied), meant)
    if not isinstance(meant, Request):
        return said
    if not wrong or not all(_is_clear(task.things, wrong) for task in meant.tasks):
        return replace(said, more=True)
    return replace(meant, tasks=tuple(task.without(wrong) for task in meant.tasks))


def _same_deed(denied: Said, meant: Answer) -> Said:
    """As in "do not bring the apple but the pear"."""
    match denied:
        case Request(tasks=[task]) if task.things and meant.things:
            return replace(denied, tasks=(replace(task, things=meant.things),))
    return meant


def _named(said: Said) -> tuple[Thing, ...]:
    """The things that are not meant; none if one is not named."""
    match said:
        case Request(tasks=[task]) if not (task.source or task.goal):
            things = task.things
        case Answer(things=things):
            pass
        case _:
            return ()
    if not things or not all(map(_is_named, things.members)):
        return ()
    return tuple(replace(thing, alone=True) for thing in things.members)


def _is_clear(things: Things | None, wrong: tuple[Thing, ...]) -> bool:
    """Whether each is named, and none of them is what is not meant."""
    left_out = {thing.words for thing in wrong}
    members = things.members if things else ()
    return bool(members) and all(_is_named(t) and t.words not in left_out for t in members)


def _is_named(thing: Thing) -> bool:
    return bool(thing.words) and not (thing.pronoun or thing.other)
