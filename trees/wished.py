"""What is asked for while a task is at hand: in its place, before it, if it fails, or after it."""

from dataclasses import replace
from itertools import chain

from executive.language.commands import LEAVE_OUT_PLACES, commands_in, left_alone
from executive.language.meaning import Request
from executive.language.pronouns import resolved
from executive.types.commands import Command, CommandKind, Commands
from trees.at_hand import of_all_spoken
from trees.context import MissionContext
from trees.meant import goes_elsewhere, leaves_out_a_place, less_what_is_left_out
from trees.taken_back import is_about, refused
from trees.wishes import added, done_first, objects_of, replaced


def take_in(
    context: MissionContext, said: Request, words: str, at_hand: Command | None, now: str
) -> str:
    """Put it on the agenda where it belongs, and say so."""
    commands = commands_in(resolved(said, of_all_spoken(context.situation, said)), words)
    if not isinstance(commands, tuple):
        return added(context, commands, now)
    if leaves_out_a_place(context, chain.from_iterable(commands)):
        return f"I cannot {LEAVE_OUT_PLACES}. {now}"
    elsewhere = _elsewhere(context, commands, at_hand)
    commands = less_what_is_left_out(context, commands)
    if alone := left_alone(said):
        return _instead_of(context, alone, commands, at_hand)
    if at_hand:
        if fails := _if_it_fails(context, commands, at_hand):
            return replaced(context, ((fails,),))
        if elsewhere or _in_its_stead(context, said, at_hand) or _lets_go(context, commands):
            return replaced(context, commands)
        if said.first:
            return done_first(context, commands, at_hand)
    return added(context, commands, now)


def _elsewhere(context: MissionContext, commands: Commands, at_hand: Command | None) -> bool:
    """Whether what is at hand is to go elsewhere: "put it on the sofa, not the desk".

    Tasks that wait, and whose things are to go elsewhere, are struck out.
    """

    def is_changed(before: Command) -> bool:
        each = chain.from_iterable(commands)
        return any(goes_elsewhere(context, command, before) for command in each)

    agenda = context.situation.agenda
    for task in [task for task in agenda.whole_tasks if is_changed(task.command)]:
        agenda.tasks.remove(task)
    return at_hand is not None and is_changed(at_hand)


def _in_its_stead(context: MissionContext, said: Request, at_hand: Command) -> bool:
    """Whether a certain thing is wanted instead of that at hand: "the drill, not the hammer"."""
    things = [t for task in said.tasks if task.things for t in task.things.members]
    certain = (t for t in things if t.definite and t.number is None)
    left_out = (but.words for thing in certain for but in thing.exceptions if but.words)
    return any(is_about(context, words, at_hand) for words in left_out)


def _lets_go(context: MissionContext, commands: Commands) -> bool:
    """Whether what is in the hand is to be put down: now, and not when it is there."""
    match commands:
        case [[Command(kind=CommandKind.PUT_DOWN)]]:
            return context.situation.hand.in_hand is not None
    return False


def _if_it_fails(context: MissionContext, commands: Commands, at_hand: Command) -> Command | None:
    """The task at hand with what is to be done if the thing is not there; None if that is unasked.

    As in "if you cannot find it, bring the mug".
    """
    match commands:
        case [[Command(kind=CommandKind.CHECK, conditional=True, unless=Command()) as command]]:
            pass
        case _:
            return None
    if at_hand.conditional or objects_of(context, command) != objects_of(context, at_hand):
        return None
    sought = replace(command, conditional=False, unless=None) if command.source else None
    source = command.source or at_hand.source
    return replace(at_hand, conditional=True, source=source, sought=sought, unless=command.unless)


def _instead_of(
    context: MissionContext, alone: str, commands: Commands, at_hand: Command | None
) -> str:
    """Do these, and leave alone what is named: it may be what the task at hand is about."""
    if at_hand and is_about(context, alone, at_hand):
        return replaced(context, commands)
    said = refused(context, alone, at_hand)
    return " ".join(filter(None, (said, added(context, commands, ""))))
