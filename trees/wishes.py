"""What is wished while the robot is at something: at once, first, or afterwards."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

from executive.language.phrases import NEGATION
from executive.types.commands import Command, Commands
from trees.context import MissionContext
from trees.telling import in_one_breath


def replaced(context: MissionContext, commands: Commands, instead: str = " instead") -> str:
    """Do these at once in place of the task at hand."""
    first, *others = chain.from_iterable(commands)
    context.situation.agenda.replace(first, others)
    return f"All right: I {in_one_breath(context, (first, *others))}{instead}."


def done_first(context: MissionContext, commands: Commands, at_hand: Command) -> str:
    """Do these at once, and the task at hand after them."""
    first, *others = chain.from_iterable(commands)
    agenda = context.situation.agenda
    agenda.tasks[:] = [t for t in agenda.tasks if not _same(t.command, (first, *others))]
    if not _same(at_hand, (first, *others)):
        others.append(at_hand)
    agenda.replace(first, others)
    return f"All right: I {in_one_breath(context, chain.from_iterable(commands))} first."


def _same(command: Command, others: Sequence[Command]) -> bool:
    """Whether it is one of the others, however it was said."""
    return replace(command, words="") in [replace(one, words="") for one in others]


def added(context: MissionContext, commands: Commands | str | None, now: str) -> str:
    """Do these afterwards."""
    if not isinstance(commands, tuple):
        return commands or f"I do not understand that. {now}"
    context.situation.agenda.add(commands)
    return f"All right: I {in_one_breath(context, chain.from_iterable(commands))} afterwards."


def named_in(context: MissionContext, words: str) -> set[str]:
    """The things that words name."""
    names = context.knowledge.names_in(NEGATION.sub(" ", words.lower().replace("_", " ")))
    return {one for name in names for one in context.knowledge.objects_named(name)}


def objects_of(context: MissionContext, command: Command) -> set[str]:
    """The things that it may be about."""
    names = command.among or (command.target,)
    return {one for name in names for one in context.knowledge.objects_named(name)}
