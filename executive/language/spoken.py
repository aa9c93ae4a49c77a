"""What was spoken of before: what "it", "there", "another" and "again" stand for."""

from dataclasses import dataclass, replace

from pydantic import TypeAdapter

from executive.language.folding import asks_for_things, folded, is_it
from executive.language.meaning import (
    ALL,
    ME,
    SO,
    Again,
    Answer,
    Correction,
    Question,
    Request,
    Said,
    Statement,
    Task,
    Thing,
    Things,
    Where,
)
from executive.types import CommandKind

_OF_ALL = ("them", "those", "these")
_OF_THE_HAND = (CommandKind.PUT, CommandKind.PUT_BACK, CommandKind.PUT_DOWN)
"""What is put somewhere is first of all what the hand holds."""
_THERE = ("there", "over there")
_ONE = "one"
"""Of a kind that was spoken of."""
_ANYWHERE = (CommandKind.COUNT, CommandKind.CHECK)
"""Questions that need no place: "how many fruits are there"."""


@dataclass(frozen=True, slots=True)
class Spoken:
    """What was spoken of last.

    Attributes:
        things: names of the things that it was about, the last one at the end.
        called: how they were called: "fruit".
        place: where they are, or the robot is to be.
        request: what was asked for last, with names in it.
    """

    things: tuple[str, ...] = ()
    called: str = ""
    place: str = ""
    request: Request | None = None

    def to_json(self) -> str:
        """As a recording keeps it."""
        return _SPOKEN.dump_json(self, exclude_defaults=True).decode()

    @classmethod
    def from_json(cls, text: str) -> "Spoken":
        """As a recording kept it.

        Raises:
            ValueError: if it is something else.
        """
        return _SPOKEN.validate_json(text)


_SPOKEN = TypeAdapter(Spoken)
NOTHING = Spoken()


def resolved(said: Said, spoken: Spoken, *, holds: bool = False) -> Said:
    """The same with names for words that stand for what was spoken of before.

    Where nothing was, they stay as they are.

    Args:
        said: as it was read.
        spoken: of what was spoken before.
        holds: whether the hand holds something, which is the first "it" to be put somewhere.
    """
    match said:
        case Again():
            return spoken.request or said
        case Request():
            return replace(said, tasks=_tasks(said.tasks, spoken, holds))
        case Statement():
            where = _where(said.where, None, None, spoken)
            assert where
            return replace(said, things=_things(said.things, spoken), where=where)
        case Question(things=Things() as things):
            return replace(said, things=_things(things, spoken))
        case Correction():
            return asked_anew(with_names(said, spoken), spoken)
        case Answer(where=(place,)) if spoken.things:  # "it is on the sofa", of what was not found
            where = _where(place, None, None, spoken)
            assert where
            name = spoken.things[-1]
            return Statement(Things((Thing(name, definite=True, said=name),)), where)
    return said


def with_names(said: Correction, spoken: Spoken) -> Correction:
    """The same with names for words that stand for what was spoken of."""
    match said.meant:
        case Request() as request:
            tasks = _tasks(request.tasks, spoken, holds=False)
            return replace(said, meant=replace(request, tasks=tasks))
        case Things() as things:
            return replace(said, meant=_things(things, spoken))
    return said


def after(said: Said, before: Spoken, *, things: tuple[str, ...] = (), place: str = "") -> Spoken:
    """What was spoken of, when this was said.

    Args:
        said: with names for pronouns.
        before: what was spoken of before.
        things: the objects that it turned out to be about.
        place: where they turned out to be.
    """
    match said:
        case Request():
            named = [task for task in said.tasks if task.things]
            called = _called(named[-1].things) if named else ""
            goal = next((t.goal.words for t in reversed(said.tasks) if t.goal), "")
            new = replace(before, request=said, called=called or before.called)
        case Statement() | Question(things=Things()):
            assert said.things
            new, goal = replace(before, called=_called(said.things)), ""
        case _:
            return before
    return replace(new, things=things or before.things, place=goal or place or before.place)


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


def in_place_of(task: Task, things: Things) -> Task:
    """The task with other things; a number alone is of the same kind, a name may be a place."""
    if task.things is None and task.goal:  # "go to the kitchen", "no, the bedroom"
        return replace(
            task, goal=replace(task.goal, words=" or ".join(t.words for t in things.members))
        )
    kind = task.things.members[0].words if task.things else ""
    members = tuple(
        t if t.words or t.pronoun else replace(t, words=kind, said=f"{t.said} {kind}")
        for t in things.members
    )
    return replace(task, things=replace(things, members=members))


def _tasks(
    tasks: tuple[Task, ...], spoken: Spoken, holds: bool, things: Things | None = None
) -> tuple[Task, ...]:
    """With names for what was named before in the same breath, else for what was spoken of.

    What a condition names is nearer than that: "if there is an apple, bring it". The `things` are
    what was named before all of the tasks.
    """
    done: list[Task] = []
    place: Where | None = None
    for task in folded([_after_question(task, spoken) for task in tasks]):
        meant = _meant_by(task, _named_in(task.sought) or things, spoken, holds)
        source, goal = (_where(where, things, place, spoken) for where in (task.source, task.goal))
        if _is_there(source) and (task.verb in _ANYWHERE or asks_for_things(task)):
            source = None  # "how many fruits are there"
        sought = task.sought and _tasks((task.sought,), spoken, holds, meant)[0]
        done.append(replace(task, things=meant, source=source, goal=goal, sought=sought))
        things = meant if meant and not is_it(meant) else things
        place = next((p for p in (goal, source) if p and not p.pronoun and p != ME), place)
    return tuple(done)


def _after_question(task: Task, spoken: Spoken) -> Task:
    """The same with what was asked last as its condition: "is there a mug?", "if so, bring it"."""
    asked = spoken.request.tasks[-1] if spoken.request else None
    if task.sought != SO or asked is None or asked.verb != CommandKind.CHECK:
        return task
    if task.unless:
        return replace(asked, conditional=True, unless=task.unless)
    return replace(task, sought=asked)


def _named_in(condition: Task | None) -> Things | None:
    """The things that have to be there; None if they were named before."""
    things = condition.things if condition else None
    return None if is_it(things) else things


def _meant_by(task: Task, before: Things | None, spoken: Spoken, holds: bool) -> Things | None:
    """The things of a task, if some were named `before` in the same breath, or none were."""
    if task.things is None:
        return None
    if one := _one_of_kind(task.things, _called(before) or spoken.called):
        return one
    if before:
        named = is_it(task.things) and task.verb != CommandKind.PUT_DOWN
        return before.without(task.things.exceptions) if named else task.things
    in_hand = holds and task.verb in _OF_THE_HAND
    return task.things if in_hand else _things(task.things, spoken)


def _one_of_kind(things: Things, kind: str) -> Things | None:
    """As in "is there a mug? If so, bring me one"; None if it is something else."""
    if not kind or [thing.words for thing in things.members] != [_ONE]:
        return None
    thing = replace(things.members[0], words=kind, number=1, said=kind)
    return replace(things, members=(thing,))


def _things(things: Things, spoken: Spoken) -> Things:
    members = tuple(one for thing in things.members for one in _meant(thing, spoken))
    return replace(things, members=members)


def _meant(thing: Thing, spoken: Spoken) -> tuple[Thing, ...]:
    """The things that a word stands for."""
    if thing.other:
        return (_another(thing, spoken),)
    if not thing.pronoun or not spoken.things:
        return (thing,)
    every = thing.number == ALL or thing.words in _OF_ALL
    names = spoken.things if every else spoken.things[-1:]
    return tuple(Thing(name, exceptions=thing.exceptions, said=name) for name in names)


def _another(thing: Thing, spoken: Spoken) -> Thing:
    """As in "another one": of the same kind, and not that of before."""
    kind = spoken.called if thing.pronoun else thing.words
    if not kind:
        return thing
    others = tuple(Thing(name, said=name) for name in spoken.things)
    return Thing(kind, 1, exceptions=(*thing.exceptions, *others), said=kind)


def _where(
    where: Where | None, things: Things | None, place: Where | None, spoken: Spoken
) -> Where | None:
    """The place that "there" stands for; beside "it" is beside the thing."""
    if where is None or not where.pronoun:
        return where
    if _is_there(where):
        return place or (_named(where, spoken.place) if spoken.place else where)
    named = [thing.words for thing in things.members if thing.words] if things else spoken.things
    return _named(where, named[-1]) if named else where


def _named(where: Where, words: str) -> Where:
    return replace(where, words=words, pronoun=False)


def _is_there(where: Where | None) -> bool:
    return where is not None and where.pronoun and where.words in _THERE


def _called(things: Things | None) -> str:
    """How the last of the things was called; empty for a pronoun."""
    thing = things.members[-1] if things and things.members else Thing()
    return "" if thing.pronoun else thing.words
