"""What is asked for during a task: done instead, before, if it fails, or afterwards."""

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
    """Put the request in the right place of the agenda; return the robot's reply."""
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
    """Whether the current task gets another goal: "put it on the sofa, not the desk".

    Drops the waiting tasks whose things get another goal.
    """

    def is_changed(before: Command) -> bool:
        each = chain.from_iterable(commands)
        return any(goes_elsewhere(context, command, before) for command in each)

    agenda = context.situation.agenda
    for task in [task for task in agenda.whole_tasks if is_changed(task.command)]:
        agenda.tasks.remove(task)
    return at_hand is not None and is_changed(at_hand)


def _in_its_stead(context: MissionContext, said: Request, at_hand: Command) -> bool:
    """Whether a certain thing replaces that of the current task: "the drill, not the hammer"."""
    things = [t for task in said.tasks if task.things for t in task.things.members]
    certain = (t for t in things if t.definite and t.number is None)
    left_out = (but.words for thing in certain for but in thing.exceptions if but.words)
    return any(is_about(context, words, at_hand) for words in left_out)


def _lets_go(context: MissionContext, commands: Commands) -> bool:
    """Whether the held thing is to be put down, which is done at once, not after the task."""
    match commands:
        case [[Command(kind=CommandKind.PUT_DOWN)]]:
            return context.situation.hand.in_hand is not None
    return False


def _if_it_fails(context: MissionContext, commands: Commands, at_hand: Command) -> Command | None:
    """The current task with a deed for its failure: "if you cannot find it, bring the mug".

    None if the commands are no such deed.
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
    """Do the commands, and drop the task about `alone`, which may be the current one."""
    if at_hand and is_about(context, alone, at_hand):
        return replaced(context, commands)
    said = refused(context, alone, at_hand)
    return " ".join(filter(None, (said, added(context, commands, ""))))
