"""Which things and places words mean, as far as nobody has to be asked."""

from executive.interfaces import Knowledge
from executive.situation import Situation
from executive.types import PERSON, Command
from trees.context import MissionContext
from trees.person import without_exceptions


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
    return without_exceptions(context, tuple(dict.fromkeys(names)))


def robot_at(situation: Situation) -> str:
    """The place that the robot went to last, as far as this task tells; else the person."""
    if not situation.dialogue.away:
        return PERSON
    return situation.hand.put_at or next(reversed(situation.search.looks.visited), PERSON)
