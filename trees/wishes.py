"""Changes to the agenda during a task: something at once, first, or afterwards; or less."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

from executive.language.meaning import Things
from executive.language.phrases import NEGATION
from executive.types.commands import Command, Commands
from executive.types.outcome import MissionStatus
from trees.context import MissionContext
from trees.telling import in_one_breath
from trees.telling import number as in_letters


def replaced(context: MissionContext, commands: Commands, instead: str = " instead") -> str:
    """Do the commands instead of the current task."""
    first, *others = chain.from_iterable(commands)
    context.situation.agenda.replace(first, others)
    return f"All right: I {in_one_breath(context, (first, *others))}{instead}."


def done_first(context: MissionContext, commands: Commands, at_hand: Command) -> str:
    """Do the commands first, and the current task after them."""
    first, *others = chain.from_iterable(commands)
    agenda = context.situation.agenda
    agenda.tasks[:] = [t for t in agenda.tasks if not _same(t.command, (first, *others))]
    if not _same(at_hand, (first, *others)):
        others.append(at_hand)
    agenda.replace(first, others)
    return f"All right: I {in_one_breath(context, chain.from_iterable(commands))} first."


def waiting_first(context: MissionContext, things: Things, at_hand: Command, now: str) -> str:
    """Do the tasks about these things first; empty if there are none.

    If that is the current task, nothing changes, and the reply is `now`.
    """
    wanted = (at_hand, *(task.command for task in context.situation.agenda.whole_tasks))
    wishes = [
        command
        for thing in things.members
        for command in wanted
        if objects_of(context, command)
        and objects_of(context, command) <= named_in(context, thing.words)
    ]
    if wishes == [at_hand]:
        return now
    return done_first(context, tuple((one,) for one in wishes), at_hand) if wishes else ""


def only_so_many(context: MissionContext, number: int, at_hand: Command) -> str:
    """Limit the number of things, including those that are done; empty if that is no reduction."""
    agenda = context.situation.agenda
    if agenda.wholes:
        if agenda.wholes[-1].wanted <= number:
            return ""
        agenda.limit(number)
        return f"All right: only {in_letters(number)}.{still_held(context)}"
    alike = (at_hand.words, at_hand.kind)
    waiting = [t for t in agenda.whole_tasks if (t.command.words, t.command.kind) == alike]
    done = sum(t.kind == at_hand.kind and t.status == MissionStatus.DONE for t in agenda.ended)
    if number >= done + 1 + len(waiting):
        return ""
    wanted = [at_hand, *(task.command for task in waiting)][: max(number - done, 0)]
    for task in waiting[max(number - done - 1, 0) :]:
        agenda.strike_out(task)
    if not wanted:
        agenda.take_back()
        return f"All right: no more of them.{still_held(context)}"
    return f"All right: I {in_one_breath(context, wanted)}, and no more."


def still_held(context: MissionContext) -> str:
    """What is in the hand when the current task is taken back, as a further sentence."""
    held = context.situation.hand.in_hand
    is_held = held and context.situation.agenda.taken_back
    return f" I still hold {context.say.the(held or '')}." if is_held else ""


def _same(command: Command, others: Sequence[Command]) -> bool:
    """Whether the command is one of the others, whatever its wording."""
    return replace(command, words="") in [replace(one, words="") for one in others]


def added(context: MissionContext, commands: Commands | str | None, now: str) -> str:
    """Do these afterwards; what is said twice is done once."""
    if not isinstance(commands, tuple):
        return commands or f"I do not understand that. {now}"
    agenda = context.situation.agenda
    at_hand = agenda.whole_of(context.situation.request.command)
    match commands:
        case [[Command() as command]] if len(objects_of(context, command)) == 1:
            waiting = [task.command for task in agenda.whole_tasks]
            if not waiting and at_hand and _same(command, (at_hand,)):
                return now
            if not _same(command, waiting[-1:]):
                agenda.add(commands)
        case _:
            agenda.add(commands)
    return f"All right: I {in_one_breath(context, chain.from_iterable(commands))} afterwards."


def named_in(context: MissionContext, words: str) -> set[str]:
    """The objects that the words name."""
    names = context.knowledge.names_in(NEGATION.sub(" ", words.lower().replace("_", " ")))
    return {one for name in names for one in context.knowledge.objects_named(name)}


def objects_of(context: MissionContext, command: Command) -> set[str]:
    """The objects that the command may be about."""
    names = command.among or (command.target,)
    return {one for name in names for one in context.knowledge.objects_named(name)}
