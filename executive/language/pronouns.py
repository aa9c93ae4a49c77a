"""Names in place of the words that stand for what was spoken of: "it", "two of them", "there"."""

from dataclasses import replace

from executive.language.anew import asked_anew, one_of_kind
from executive.language.folding import asks_for_things, folded, is_it, of_several
from executive.language.meaning import (
    ME,
    SO,
    THERE,
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
from executive.language.phrases import is_plural
from executive.language.spoken import QUESTIONS, Spoken, called
from executive.types.commands import ALL, CommandKind

_OF_THE_HAND = (CommandKind.PUT, CommandKind.PUT_BACK, CommandKind.PUT_DOWN)
"""What is put somewhere is first of all what the hand holds."""
_ANYWHERE = (CommandKind.COUNT, CommandKind.CHECK)
"""Questions that need no place: "how many fruits are there"."""
_EVERYTHING = ("all", "everything")
"""Of what was just told, if a question was."""


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
            return _told(said, None, None, spoken)
        case Question(things=Things() as things):
            return replace(said, things=_things(things, spoken))
        case Correction():
            return asked_anew(with_names(said, spoken), spoken)
        case Answer(things=None, where=(place,), told=False) if _went_somewhere(spoken):
            return asked_anew(Correction(place=place), spoken)  # "on the desk": not where it is
        case Answer(where=(place,)) if spoken.things:  # "it is on the sofa", of what was not found
            where = _where(place, None, None, spoken)
            assert where
            name = spoken.things[-1]
            return Statement(Things((Thing(name, definite=True, said=name),)), where)
    return said


def _went_somewhere(spoken: Spoken) -> bool:
    """Whether what was asked for last has a place where a thing, or the robot, is to go."""
    return spoken.request is not None and spoken.request.tasks[-1].goal not in (None, ME)


def _told(said: Statement, things: Things | None, place: Where | None, spoken: Spoken) -> Statement:
    """With names for what was told of before in the same breath, else for what was spoken of."""
    meant = things if things and is_it(said.things) else _things(said.things, spoken)
    where = _where(said.where, things, place, spoken)
    assert where
    more = said.more and _told(said.more, meant, where, spoken)
    return replace(said, things=meant, where=where, more=more)


def with_names(said: Correction, spoken: Spoken) -> Correction:
    """The same with names for words that stand for what was spoken of."""
    match said.meant:
        case Request() as request:
            tasks = _tasks(request.tasks, spoken, holds=False)
            return replace(said, meant=replace(request, tasks=tasks))
        case Things() as things:
            return replace(said, meant=_things(things, spoken))
    return said


def _tasks(
    tasks: tuple[Task, ...],
    spoken: Spoken,
    holds: bool,
    things: Things | None = None,
    place: Where | None = None,
) -> tuple[Task, ...]:
    """With names for what was named before in the same breath, else for what was spoken of.

    What a condition names is nearer than that: "if there is an apple, bring it". The `things` and
    the `place` are what was named before all of the tasks.
    """
    done: list[Task] = []
    named: tuple[Thing, ...] = things.members if things else ()
    for task in folded([_after_question(task, spoken) for task in tasks]):
        if not (things or spoken.things):
            task = _with_own_things(task)
        before = _named_in(task.sought) or (_all_of(task.things, named) or things)
        in_this_breath = tuple(thing.words for thing in named)
        meant = (
            _the_other(task.things, things, in_this_breath)
            or _the_other(task.things, things, spoken.things)
            or _meant_by(task, before, spoken, holds)
        )
        near = _named_place(task.sought) or place
        source, goal = (_where(where, things, near, spoken) for where in (task.source, task.goal))
        if _is_there(source) and (task.verb in _ANYWHERE or asks_for_things(task)):
            source = None  # "how many fruits are there"
        nearest = _before_condition(task, meant, things, spoken)
        sought = task.sought and _tasks((task.sought,), spoken, holds, nearest, place)[0]
        meant_so = replace(task, things=meant, source=source, goal=goal, sought=sought)
        there = _named_place(meant_so) or near
        unless = task.unless and _tasks((task.unless,), spoken, holds, meant, there)[0]
        done.append(replace(meant_so, unless=unless))
        things = meant if meant and not is_it(meant) else things
        named += things.members if things and things is meant else ()
        place = _named_place(meant_so) or place
    return tuple(done)


def _named_place(task: Task | None) -> Where | None:
    """Where its things are to go, else where they are; None if no place is named."""
    places = (task.goal, task.source) if task else ()
    return next((p for p in places if p and not p.pronoun and p != ME), None)


def _with_own_things(task: Task) -> Task:
    """Where nothing was spoken of, "it" in "if it is not there, bring the pear" is the pear."""
    of_nothing = task.verb == CommandKind.CHECK and task.sought is None and is_it(task.things)
    if of_nothing and task.unless and task.unless.things:
        return replace(task, things=task.unless.things)
    return task


def _before_condition(
    task: Task, meant: Things | None, things: Things | None, spoken: Spoken
) -> Things | None:
    """What a condition may call "it".

    In "if it is on the desk, bring the pear" that was spoken of before, if anything was; otherwise
    it is what is to be done something with.
    """
    if task.sought and is_it(task.sought.things) and not is_it(task.things):
        return things or (None if spoken.things else meant)
    return meant


def _after_question(task: Task, spoken: Spoken) -> Task:
    """The same with what was asked last as its condition: "is there a mug?", "if so, bring it"."""
    asked = spoken.request.tasks[-1] if spoken.request else None
    if task.sought != SO or asked is None or asked.verb != CommandKind.CHECK:
        return task
    if task.things is None and task.verb == CommandKind.CHECK:  # "if not, bring the pear"
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
    members = before.members if before else tuple(map(_called, spoken.things))
    if len(members) < 2 and all(thing.place_in_list for thing in task.things.members):
        members = tuple(map(_called, spoken.things))  # "bring the first and put the second there"
    seen = not before and spoken.request and spoken.request.tasks[-1].verb in QUESTIONS
    if seen and not task.source and (rest := _all_but(task.things, members)):
        return rest
    if seen and len(members) > 1 and is_it(task.things) and not of_several(task.things):
        return _which(task.things, spoken)
    if picked := _picked(task.things, members):
        return picked
    if _unclear(task.things, members):
        return task.things
    kind = called(before) or spoken.called
    if kind and (one := one_of_kind(task.things, kind)):
        return Things(members, one_of=True) if seen and len(members) > 1 else one
    if before:
        named = is_it(task.things) and task.verb != CommandKind.PUT_DOWN
        return before.without(task.things.exceptions) if named else task.things
    in_hand = holds and task.verb in _OF_THE_HAND
    return task.things if in_hand else _things(task.things, spoken)


def _which(things: Things, spoken: Spoken) -> Things:
    """As in "bring it", where several were seen: that has to be asked."""
    if not spoken.called or is_plural(spoken.called):
        return things
    kind = Thing(spoken.called, definite=True, said=spoken.called)
    return Things((kind,)).without(things.exceptions)


def _all_of(things: Things | None, named: tuple[Thing, ...]) -> Things | None:
    """All that was named in the same breath, if the words stand for more than one thing of it."""
    return Things(named) if named and of_several(things) else None


def _picked(things: Things, members: tuple[Thing, ...]) -> Things | None:
    """Those of several that "both of them", "two of them", "the first one" are; None if none."""
    if not all(thing.pronoun and not thing.other for thing in things.members) or len(members) < 2:
        return None
    if places := [t.place_in_list for t in things.members if t.place_in_list is not None]:
        listed = [at - (at > 0) for at in places if at and -len(members) <= at <= len(members)]
        is_there = len(listed) == len(things.members)
        return replace(things, members=tuple(members[at] for at in listed)) if is_there else None
    [thing, *others] = things.members
    number = thing.number or 0
    if others:
        return None
    if number == ALL or number == len(members) or (of_several(things) and not number):
        return _less(members, thing.exceptions)
    some = Things(members, one_of=True, number=number).without(thing.exceptions)
    return some if 0 < number < len(members) and not thing.definite else None


def _unclear(things: Things, members: tuple[Thing, ...]) -> bool:
    """Whether it is not known which are meant: "both of them", if three were spoken of."""
    return any(thing.is_so_many for thing in things.members) and len(members) > 1


def _all_but(things: Things, members: tuple[Thing, ...]) -> Things | None:
    """As in "bring all but the apple", "bring everything", of what was just told.

    None if it is something else.
    """
    if len(things.members) != 1 or len(members) < 2:
        return None
    [thing] = things.members
    if thing.words or thing.number != ALL or not thing.said.startswith(_EVERYTHING):
        return None
    return _less(members, thing.exceptions)


def _less(members: tuple[Thing, ...], left_out: tuple[Thing, ...]) -> Things:
    """Those that are not left out: "them but not the pear"."""
    names = {but.words for but in left_out}
    rest = tuple(one for one in members if one.words.replace("_", " ") not in names)
    return Things(rest) if rest and len(rest) < len(members) else Things(members).without(left_out)


def _the_other(
    things: Things | None, before: Things | None, spoken_of: tuple[str, ...]
) -> Things | None:
    """Of two that were spoken of, that which is not named before: "the mug, and the other one"."""
    [thing, *others] = things.members if things else (Thing(),)
    named = {one.words.replace("_", " ") for one in before.members} if before else set()
    both = tuple(dict.fromkeys(name.replace("_", " ") for name in spoken_of))
    left = [name for name in both if name not in named]
    is_other = before and not others and thing.other and thing.pronoun
    return Things((_called(left[0]),)) if is_other and len(left) == 1 < len(both) else None


def _called(name: str) -> Thing:
    return Thing(name, said=name)


def _things(things: Things, spoken: Spoken) -> Things:
    members = tuple(one for thing in things.members for one in _meant(thing, spoken))
    return replace(things, members=members)


def _meant(thing: Thing, spoken: Spoken) -> tuple[Thing, ...]:
    """The things that a word stands for."""
    if thing.other:
        return (_another(thing, spoken),)
    if not thing.pronoun or not spoken.things or thing.place_in_list is not None:
        return (thing,)  # of these, a number in the list is known already, or there is none
    if (thing.number or 0) > 1 and (kind := spoken.called or spoken.things[-1]):
        return (Thing(kind, thing.number, said=f"{thing.said.partition(' ')[0]} {kind}"),)
    every = thing.number == ALL or of_several(Things((thing,)))
    names = spoken.things if every else spoken.things[-1:]
    return tuple(Thing(name, exceptions=thing.exceptions, said=name) for name in names)


def _another(thing: Thing, spoken: Spoken) -> Thing:
    """As in "another one": of the same kind, and not that of before."""
    kind = spoken.called if thing.pronoun else thing.words
    if not kind:
        return thing
    others = tuple(Thing(name, said=name) for name in spoken.things)
    number = thing.number or 1
    return Thing(kind, number, exceptions=(*thing.exceptions, *others), said=kind)


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
    return where is not None and where.pronoun and where.words in THERE
