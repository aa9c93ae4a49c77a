"""What is not to be done, now or later, of all that was asked for."""

import re
from dataclasses import replace

from executive.language.answers import picked, things_in
from executive.language.commands import THING
from executive.language.meaning import Answer, Refusal, Request
from executive.language.wording import either
from executive.situation import Task
from executive.types.commands import ALL, Command, CommandKind
from trees.context import MissionContext
from trees.telling import NUMBERS, in_one_sentence
from trees.wishes import named_in, objects_of, replaced, still_held

_IT = frozenset(("it", "that", "this", "them"))
_SEVERAL = frozenset(("them", "both", "those", "these"))
_REST = re.compile(r"(?:^|\bthe )rest\b|\b(?:every|any)thing else\b")
_OTHERS = re.compile(r"\b(?:the|all) others?\b(?: (?:one|two|three|four|five|ones)\b)?")
_ALL = re.compile(
    r"\b(?:anything|everything|all|any|nothing|none)\b(?!.*\b(?:else|but|except)\b)", re.I
)


def refused(context: MissionContext, words: str, at_hand: Command | None) -> str:
    """Drop all tasks that the words are about, now or later; empty if there is no such task."""
    if at_hand and _REST.search(words.lower()):
        return _nothing_more(context, _named(context, words))
    agenda = context.situation.agenda
    named = _named(context, words) or _of_those_asked_for(context, words, at_hand)
    everything = not named and _means_all(words)
    breath = at_hand.words if at_hand and not named and _SEVERAL & _words(words) else None
    waiting = [
        task
        for task in agenda.tasks
        if everything or task.command.words == breath or named & objects_of(context, task.command)
    ]
    is_now = context.situation.request.object in named
    is_part = bool(named) and not is_now and any(task.depth for task in waiting)
    left_out: list[Command] = []
    if at_hand and not is_part and (others := _others(context, at_hand, named)):
        for task in waiting:
            _leave_out(context, task, named)
        return replaced(context, ((others,),))
    if at_hand and not is_part and is_about(context, words, at_hand):
        agenda.take_back()
        context.situation.request.command = at_hand
        left_out.append(at_hand)
    for task in waiting:
        if task in agenda.tasks:
            left_out.append(_leave_out(context, task, named))
    wishes = [in_one_sentence(context, command) for command in left_out]
    return f"Then I do not {either(wishes)}.{still_held(context)}" if wishes else ""


def _named(context: MissionContext, words: str) -> set[str]:
    """The things that words name, less those that they except: "all the fruit but the pear"."""
    things = things_in(context.interpreter.read(words))
    excepted = [but.words for but in things.exceptions if not but.alone] if things else []
    return named_in(context, words) - named_in(context, " or ".join(excepted))


def _nothing_more(context: MissionContext, named: set[str]) -> str:
    """Do the current task and drop the waiting ones; if things are named, only those with them.

    As in "forget the rest", "forget the rest of the fruit".
    """
    waiting = [
        task
        for task in context.situation.agenda.tasks
        if not named or named & objects_of(context, task.command)
    ]
    left_out = [_leave_out(context, task, named) for task in waiting]
    wishes = [in_one_sentence(context, command) for command in left_out]
    return (
        f"Then I do not {either(wishes)}." if wishes else "There is nothing else that I was to do."
    )


def _of_those_asked_for(context: MissionContext, words: str, at_hand: Command | None) -> set[str]:
    """The things that "the first one" or "the others" mean, of all that was asked for at once.

    "The others" are those that were not begun. Empty if it is not clear.
    """
    if at_hand is None:
        return set()
    tasks = context.situation.agenda.whole_tasks
    waiting = [task.command for task in tasks if task.command.words == at_hand.words]
    if found := _OTHERS.search(words.lower()):
        number = found[0].rpartition(" ")[2]
        fits = number not in NUMBERS or NUMBERS.index(number) == len(waiting)
        meant = waiting if fits else []
    else:
        as_named = sorted([at_hand, *waiting], key=lambda one: at_hand.words.find(one.target))
        said = context.interpreter.read(words)
        said = context.interpreter.read(said.words) if isinstance(said, Refusal) else said
        if isinstance(said, Request) and (things := said.tasks[0].things):  # "bring the first one"
            said = Answer(place_in_list=things.members[0].place_in_list)
        names = picked(said, [one.target for one in as_named]) if waiting else ()
        meant = [one for one in as_named if one.target in names]
    return {name for one in meant for name in objects_of(context, one)}


def _others(context: MissionContext, at_hand: Command, named: set[str]) -> Command | None:
    """The task without the named things; None if too few would be left, or it is not about them."""
    things = objects_of(context, at_hand)
    if named and at_hand.kind == CommandKind.CLEAR and not things:  # whatever is there
        left_out = tuple(sorted(named))
        exceptions = (*at_hand.exceptions, *left_out)
        return replace(at_hand, target=THING, number=ALL, exceptions=exceptions)
    left_out, others = tuple(sorted(named & things)), things - named
    enough = 1 < at_hand.number <= len(others) or (others and _of_all(at_hand))
    if not left_out or not enough:
        return None
    return replace(at_hand, exceptions=(*at_hand.exceptions, *left_out))


def _of_all(command: Command) -> bool:
    """Whether the command is about all things of a kind."""
    return command.number == ALL or command.plural


def _leave_out(context: MissionContext, task: Task, named: set[str]) -> Command:
    """Drop a waiting task, or exclude the named things from it; returns what is dropped."""
    command, others = task.command, objects_of(context, task.command) - named
    if not named or not others:
        context.situation.agenda.strike_out(task)
        return command
    left_out = tuple(sorted(objects_of(context, command) & named))
    narrower = replace(command, exceptions=(*command.exceptions, *left_out))
    context.situation.agenda.change(task, narrower)
    return replace(command, target=" and ".join(left_out))


def is_about(context: MissionContext, words: str, at_hand: Command) -> bool:
    """Whether the refusal is about the current task."""
    request = context.situation.request
    if named := _named(context, words) or _of_those_asked_for(context, words, at_hand):
        return request.object in named or bool(named & objects_of(context, at_hand))
    return _means_all(words) or bool(_IT & _words(words))


def _means_all(words: str) -> bool:
    """As in "do not bring anything", but not in "I need nothing else" or "all but two"."""
    return _ALL.search(words) is not None


def _words(words: str) -> set[str]:
    return set(words.lower().split())
