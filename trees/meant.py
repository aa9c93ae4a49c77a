"""Which things words mean, as far as nobody has to be asked."""

from collections.abc import Iterable

from executive.interfaces.knowledge import Knowledge
from executive.language.spoken import QUESTIONS
from executive.types.commands import Command
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
    knowledge = context.knowledge
    return any(
        {*knowledge.places_named(but)} & {*knowledge.places_named(command.goal or but)}
        for command in commands
        for but in command.exceptions
        if knowledge.is_place(but) and not knowledge.objects_named(but)
    )
