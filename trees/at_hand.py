"""What the person says during a task: what "it" refers to, and whether it is about the same."""

from dataclasses import replace
from itertools import chain

from executive.language.commands import commands_in
from executive.language.folding import of_several
from executive.language.meaning import Request
from executive.language.pronouns import resolved
from executive.language.spoken import Spoken
from executive.situation import Situation
from trees.context import MissionContext
from trees.wishes import objects_of


def spoken_now(situation: Situation) -> Spoken:
    """The referents of "it" and "there": what the current task is about."""
    request, before = situation.request, situation.dialogue.spoken
    if not request.command:
        return before
    things = (request.object or request.command.target,)
    place = request.goal or request.command.goal or request.command.source or before.place
    return Spoken(things, request.command.target, place, before.request)


def of_all_spoken(situation: Situation, said: object) -> Spoken:
    """The same; for "them" and "both", with the waiting tasks from the same sentence."""
    spoken, at_hand = spoken_now(situation), situation.request.command
    tasks = said.tasks if isinstance(said, Request) else ()
    if at_hand is None or not any(of_several(task.things) for task in tasks):
        return spoken
    waiting = (task.command for task in situation.agenda.whole_tasks)
    others = [one.target for one in waiting if one.words == at_hand.words]
    return replace(spoken, things=(*spoken.things, *others))


def is_about_the_same(context: MissionContext, said: Request, words: str) -> bool:
    """Whether all that is asked for is about the one thing of the current task."""
    request = context.situation.request
    commands = commands_in(resolved(said, spoken_now(context.situation)), words)
    if request.object is None or not isinstance(commands, tuple):
        return False
    each = chain.from_iterable(commands)
    return all(objects_of(context, one) == {request.object} for one in each)


def differs(context: MissionContext, said: Request, words: str) -> bool:
    """Whether this asks for something else than the current task, or for more."""
    at_hand = context.situation.request.command
    commands = commands_in(resolved(said, spoken_now(context.situation)), words)
    if at_hand is None or not isinstance(commands, tuple):
        return False
    command, *others = chain.from_iterable(commands)
    same = objects_of(context, command) == objects_of(context, at_hand)
    where = (command.kind, command.source, command.goal)
    return bool(others) or not same or where != (at_hand.kind, at_hand.source, at_hand.goal)
