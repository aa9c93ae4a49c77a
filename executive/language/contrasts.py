"""Not this, but that: what is to be done in place of what is not to be done."""

import re
from collections.abc import Callable
from dataclasses import replace

from executive.language.folding import is_it
from executive.language.meaning import (
    ME,
    Answer,
    Correction,
    Refusal,
    Request,
    Said,
    Task,
    Thing,
    Things,
    Where,
)
from executive.types.commands import CommandKind

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
    if elsewhere := _elsewhere(read(denied), meant):
        return elsewhere
    if not wrong or not all(_is_clear(task.things, wrong) for task in meant.tasks):
        return replace(said, more=True)
    return replace(meant, tasks=tuple(task.without(wrong) for task in meant.tasks))


def _elsewhere(denied: Said, meant: Request) -> Correction | None:
    """As in "do not bring it to me, put it on the desk": it is the place that is denied."""
    match denied, meant.tasks:
        case Request(tasks=[before]), [Task(goal=Where() as goal) as task]:
            wrong = before.goal or (ME if before.verb == CommandKind.BRING else None)
            things = before.things if is_it(task.things) else task.things
            if things and things == before.things and wrong not in (None, goal):
                return Correction(Request((replace(task, things=things),)), denies=True)
    return None


def _same_deed(denied: Said, meant: Answer) -> Said:
    """As in "do not bring the apple but the pear", "do not put it on the desk but on the sofa"."""
    match denied, meant:
        case Request(tasks=[task]), Answer(things=Things() as things) if task.things:
            return replace(denied, tasks=(replace(task, things=things),))
        case Request(tasks=[Task(goal=Where()) as task]), Answer(things=None, where=[goal]):
            return replace(denied, tasks=(replace(task, goal=goal),))
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
