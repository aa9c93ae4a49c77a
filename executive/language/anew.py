"""What was asked for, with other things or places in it: "no, the banana"."""

from dataclasses import replace

from executive.language.meaning import ME, Correction, Request, Said, Task, Thing, Things
from executive.language.spoken import Spoken
from executive.types.commands import CommandKind

_ONE = "one"
"""A number, if it is all that is said."""


def asked_anew(said: Correction, spoken: Spoken, *, in_one_breath: bool = False) -> Said:
    """What it asks for when nothing is under way: what was asked for last, but for what it says.

    That is the last task alone; `in_one_breath` with the request, the others are still wanted, too.
    """
    if isinstance(said.meant, Request):
        others = spoken.request.tasks[:-1] if in_one_breath and spoken.request else ()
        return replace(said.meant, tasks=(*others, *said.meant.tasks))
    if spoken.request is None:
        return said
    *before, task = spoken.request.tasks
    before *= in_one_breath
    if said.meant:
        task = in_place_of(task, said.meant)
    goal = said.goal or (said.place if task.goal else None)
    source = said.source or (said.place if not task.goal else None)
    if task.verb == CommandKind.BRING and goal not in (None, ME):
        task = replace(task, verb=CommandKind.PUT)
    task = replace(task, goal=goal or task.goal, source=source or task.source)
    return replace(spoken.request, tasks=(*before, task))


def number_alone(things: Things) -> int:
    """How many, if that is all that is said: "two of them", "one"; 0 if it is not."""
    match things.members:
        case [Thing(words="", number=int(number))]:
            return number
        case [Thing(words=word)] if word == _ONE:
            return 1
    return 0


def one_of_kind(things: Things, kind: str, number: int | None = 1) -> Things | None:
    """As in "bring me one", of a kind that was spoken of; None if it is something else."""
    if [thing.words for thing in things.members] != [_ONE]:
        return None
    said = kind + things.members[0].said.partition(_ONE)[2]  # "one for Anna"
    thing = replace(things.members[0], words=kind, number=number, said=said)
    return replace(things, members=(thing,))


def in_place_of(task: Task, things: Things) -> Task:
    """The task with other things; a number alone is of the same kind, a name may be a place.

    "All" is, too, but not "everything".
    """
    if task.things is None and task.goal:  # "go to the kitchen", "no, the bedroom"
        return replace(
            task, goal=replace(task.goal, words=" or ".join(t.words for t in things.members))
        )
    kind = task.things.members[0].words if task.things else ""
    number = None if any(thing.definite for thing in things.members) else 1
    if one := one_of_kind(things, kind, number):  # "no, one"
        return replace(task, things=one)
    members = tuple(
        t
        if t.words or t.pronoun or t.said == "everything"
        else replace(t, words=kind, said=f"{t.said} {kind}")
        for t in things.members
    )
    return replace(task, things=replace(things, members=members))
