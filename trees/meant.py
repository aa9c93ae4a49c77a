"""Which things words mean, as far as nobody has to be asked."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from executive.interfaces.knowledge import Knowledge
from executive.language.spoken import QUESTIONS
from executive.types.commands import Command, Commands
from trees.context import MissionContext


def meant(knowledge: Knowledge, command: Command) -> tuple[str, ...]:
    """The objects that a command may be about: what they are called, look like, or are for."""
    if command.purpose:
        return knowledge.objects_for(command.purpose)
    return knowledge.objects_named(command.target)


def things_meant(context: MissionContext, command: Command) -> tuple[str, ...]:
    """The same, of any of the names between which the words leave the choice; less exceptions."""
    names = (
        tuple(n for name in command.among for n in context.knowledge.objects_named(name))
        if command.among
        else meant(context.knowledge, command)
    )
    return without_exceptions(context.knowledge, command, tuple(dict.fromkeys(names)))


def just_seen(context: MissionContext) -> tuple[str, ...]:
    """The things that the question before this was answered with; none if there was no question."""
    ended, spoken = context.situation.agenda.ended, context.situation.dialogue.spoken
    if ended:
        return ended[-1].things if ended[-1].kind in QUESTIONS else ()
    was_asked = spoken.request is not None and spoken.request.tasks[-1].verb in QUESTIONS
    return spoken.things if was_asked else ()


def without_exceptions(
    knowledge: Knowledge, command: Command, names: tuple[str, ...]
) -> tuple[str, ...]:
    """Those of the objects that the command does not leave out: "anything but a banana"."""
    left_out = (name for but in command.exceptions for name in (but, *knowledge.names_in(but)))
    not_meant = {one for name in left_out for one in knowledge.objects_named(name)}
    return tuple(name for name in names if name not in not_meant)


def leaves_out_a_place(context: MissionContext, commands: Iterable[Command]) -> bool:
    """Whether a place is not meant where the thing may be, or may go: "a mug, not the kitchen".

    "On the sofa, not the desk" says no more than the sofa.
    """
    places = context.knowledge.places_named
    return any(
        {*places(but)} & {*places(command.goal or but)}
        for command in commands
        for but in _places_left_out(context, command)
    )


def less_what_is_left_out(context: MissionContext, commands: Commands) -> Commands:
    """The same with only things in their exceptions, and without tasks whose own things these are.

    A place that is not meant changes nothing. Of the apple and the mug that were seen, the mug is
    "everything but the fruit"; where nothing would be left, all stay as they are.
    """
    less = tuple(
        tuple(replace(one, exceptions=_things_left_out(context, one)) for one in group)
        for group in commands
    )
    wanted = (
        tuple(one for one in group if not _is_left_out(context, one, group)) for group in less
    )
    return tuple(filter(None, wanted)) or less


def _is_left_out(context: MissionContext, command: Command, group: Sequence[Command]) -> bool:
    """Whether none of its things is meant, by what is said of the whole group."""
    of_all = all(one.exceptions == command.exceptions for one in group)
    named = meant(context.knowledge, command)
    return of_all and bool(named) and not without_exceptions(context.knowledge, command, named)


def goes_elsewhere(context: MissionContext, command: Command, before: Command) -> bool:
    """Whether its thing is to go on the sofa, and not where the task before takes it."""
    things = {*things_meant(context, before)}
    if not things or not things <= {*things_meant(context, command)}:
        return False
    places = context.knowledge.places_named
    goals = {*places(before.goal)}
    return any(goals & {*places(but)} for but in _places_left_out(context, command))


def _places_left_out(context: MissionContext, command: Command) -> tuple[str, ...]:
    things = _things_left_out(context, command)
    return tuple(but for but in command.exceptions if but not in things)


def _things_left_out(context: MissionContext, command: Command) -> tuple[str, ...]:
    """Its exceptions but for those that name a place, and no thing."""
    knowledge = context.knowledge
    return tuple(
        but
        for but in command.exceptions
        if knowledge.objects_named(but) or not knowledge.is_place(but)
    )
