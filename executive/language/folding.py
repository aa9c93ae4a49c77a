"""Tasks said in one breath, as few as say the same: "find the mug and bring it" is one."""

from collections.abc import Sequence
from dataclasses import replace

from executive.language.meaning import ME, Task, Things
from executive.types.commands import CommandKind

_ALONE = (CommandKind.FIND, CommandKind.TAKE, CommandKind.BRING)
"""Deeds that another one with "it" may follow, which has them in it."""
_THERE = (*_ALONE, CommandKind.CHECK, CommandKind.COUNT)
"""What is done where the robot was just told to go: "go to the kitchen and find the mug"."""


def folded(tasks: Sequence[Task]) -> tuple[Task, ...]:
    """As few tasks as say the same: "find the mug and bring it" is "bring the mug"."""
    done: list[Task] = []
    for task in tasks:
        before = done[-1] if done else None
        if before and _is_on_the_way(before) and _places(task):
            done[-1] = replace(task, source=before.goal)
        elif before and before.verb in _ALONE and not before.goal and _goes_on(task, done):
            goes_on = replace(before, verb=task.verb, goal=task.goal, said=task.said)
            done[-1] = goes_on.without(task.things.exceptions if task.things else ())
        else:
            done.append(task)
    return tuple(done)


def _is_on_the_way(task: Task) -> bool:
    """Whether the robot is only to go somewhere."""
    return task.verb == CommandKind.GO and task.goal not in (None, ME) and task.things is None


def _places(task: Task) -> bool:
    """Whether it has a thing that may be where the robot was told to go before."""
    return task.verb in _THERE and task.source is None and not is_it(task.things)


def _goes_on(task: Task, done: Sequence[Task]) -> bool:
    """Whether it is about the thing of the task before, and no more than that."""
    further = task.verb in (CommandKind.TAKE, CommandKind.BRING, CommandKind.PUT)
    of_all = len(done) > 1 and of_several(task.things)
    return further and is_it(task.things) and not (of_all or task.source or task.conditional)


def of_several(things: Things | None) -> bool:
    """Whether it stands for all that was named before: "them"."""
    members = things.members if things else ()
    return any(thing.pronoun and thing.words in ("them", "those", "these") for thing in members)


def is_it(things: Things | None) -> bool:
    """Whether it is one thing that was named before."""
    if things is None or len(things.members) != 1:
        return False
    [thing] = things.members
    return thing.pronoun and not thing.other and thing.number is thing.place_in_list is None


def asks_for_things(task: Task) -> bool:
    """Whether it is a question about certain things, which may be anywhere."""
    members = task.things.members if task.things else ()
    return task.verb == CommandKind.TELL and any(t.words and not t.superlative for t in members)
