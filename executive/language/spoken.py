"""What was spoken of before: what "it", "there", "another" and "again" stand for."""

from dataclasses import dataclass, replace

from pydantic import TypeAdapter

from executive.language.meaning import (
    ALL,
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
    Verb,
    Where,
)

_OF_ALL = ("them", "those", "these")
_OF_THE_HAND = (Verb.PUT, Verb.PUT_BACK, Verb.PUT_DOWN)
"""What is put somewhere is first of all what the hand holds."""


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
            where = _where(said.where, spoken)
            assert where
            return replace(said, things=_things(said.things, spoken), where=where)
        case Question(things=Things() as things):
            return replace(said, things=_things(things, spoken))
        case Correction():
            return _asked_anew(with_names(said, spoken), spoken)
        case Answer(where=(place,)) if spoken.things:  # "it is on the sofa", of what was not found
            where = _where(place, spoken)
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


def _asked_anew(said: Correction, spoken: Spoken) -> Said:
    """What it asks for when nothing is under way: what was asked for last, but for what it says."""
    if isinstance(said.meant, Request):
        return said.meant
    if spoken.request is None:
        return said
    task = spoken.request.tasks[-1]
    if said.meant:
        task = replace(task, things=said.meant)
    goal = said.goal or (said.place if task.goal else None)
    source = said.source or (said.place if not task.goal else None)
    task = replace(task, goal=goal or task.goal, source=source or task.source)
    return Request((task,))


def _tasks(tasks: tuple[Task, ...], spoken: Spoken, holds: bool) -> tuple[Task, ...]:
    """Up to the first thing that is named: "it" after that is the thing of the sentence."""
    done: list[Task] = []
    for task in tasks:
        things = task.things
        if things and not any(one.things for one in done):
            in_hand = holds and task.verb in _OF_THE_HAND
            things = things if in_hand else _things(things, spoken)
        places = (_where(task.source, spoken), _where(task.goal, spoken))
        done.append(replace(task, things=things, source=places[0], goal=places[1]))
    return tuple(done)


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


def _where(where: Where | None, spoken: Spoken) -> Where | None:
    """The place that "there" stands for; beside "it" is beside the thing."""
    if where is None or not where.pronoun:
        return where
    if where.words == "there":
        return replace(where, words=spoken.place, pronoun=False) if spoken.place else where
    return replace(where, words=spoken.things[-1], pronoun=False) if spoken.things else where


def _called(things: Things | None) -> str:
    """How the last of the things was called; empty for a pronoun."""
    thing = things.members[-1] if things and things.members else Thing()
    return "" if thing.pronoun else thing.words
