"""Which objects the words mean, as far as this is known without a question."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from executive.interfaces.knowledge import Knowledge
from executive.language.spoken import QUESTIONS
from executive.types.commands import Command, Commands
from trees.context import MissionContext


def meant(knowledge: Knowledge, command: Command) -> tuple[str, ...]:
    """The objects that a command may be about, by name, class, appearance or purpose."""
    if command.purpose:
        return knowledge.objects_for(command.purpose)
    return knowledge.objects_named(command.target)


def things_meant(context: MissionContext, command: Command) -> tuple[str, ...]:
    """The same without exceptions; if the words leave a choice between names, all of these."""
    names = (
        tuple(n for name in command.among for n in context.knowledge.objects_named(name))
        if command.among
        else meant(context.knowledge, command)
    )
    return without_exceptions(context.knowledge, command, tuple(dict.fromkeys(names)))


def just_seen(context: MissionContext) -> tuple[str, ...]:
    """The things in the answer to the previous command, if that was a question; else empty."""
    ended, spoken = context.situation.agenda.ended, context.situation.dialogue.spoken
    if ended:
        return ended[-1].things if ended[-1].kind in QUESTIONS else ()
    was_asked = spoken.request is not None and spoken.request.tasks[-1].verb in QUESTIONS
    return spoken.things if was_asked else ()


def without_exceptions(
    knowledge: Knowledge, command: Command, names: tuple[str, ...]
) -> tuple[str, ...]:
    """The objects without those that the command excludes, as in "anything but a banana"."""
    left_out = (name for but in command.exceptions for name in (but, *knowledge.names_in(but)))
    not_meant = {one for name in left_out for one in knowledge.objects_named(name)}
    return tuple(name for name in names if name not in not_meant)


def leaves_out_a_place(context: MissionContext, commands: Iterable[Command]) -> bool:
    """Whether a command excludes a place to find or put the thing: "a mug, not the kitchen".

    The exclusion in "on the sofa, not the desk" is harmless: the goal is the sofa.
    """
    places = context.knowledge.places_named
    return any(
        {*places(but)} & {*places(command.goal or but)}
        for command in commands
        for but in _places_left_out(context, command)
    )


def less_what_is_left_out(context: MissionContext, commands: Commands) -> Commands:
    """The commands with only things as exceptions, and without tasks whose own things are excluded.

    Excluded places are dropped. If an apple and a mug were seen, "everything but the fruit" means
    the mug. If no task would be left, all stay.
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
    """Whether all its things are excluded by an exception of the whole group."""
    of_all = all(one.exceptions == command.exceptions for one in group)
    named = meant(context.knowledge, command)
    return of_all and bool(named) and not without_exceptions(context.knowledge, command, named)


def goes_elsewhere(context: MissionContext, command: Command, before: Command) -> bool:
    """Whether the thing of the earlier task gets another goal: "on the sofa, not the desk"."""
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
    """Its exceptions without those that name only a place."""
    knowledge = context.knowledge
    return tuple(
        but
        for but in command.exceptions
        if knowledge.objects_named(but) or not knowledge.is_place(but)
    )
