"""When the person wants something done first, or wants only that done."""

from executive.language.anew import number_alone
from executive.language.answers import things_in
from executive.language.corrections import corrected
from executive.language.meaning import Correction, Refusal, Thing, Things
from executive.types.commands import Command
from trees.context import MissionContext
from trees.corrections import correct
from trees.telling import in_one_breath
from trees.wishes import done_first, named_in, objects_of, only_so_many, waiting_first


def first_of_all(
    context: MissionContext, things: Things, at_hand: Command, words: str, now: str
) -> str:
    """Do what is named first: a waiting task, or the current deed with these things."""
    if any(thing.pronoun for thing in things.members):
        return f"{context.interpreter.not_understood(words)}. {now}"
    if said := waiting_first(context, things, at_hand, now):
        return said
    commands = corrected(Correction(things), at_hand, words)
    return commands if isinstance(commands, str) else done_first(context, commands, at_hand)


def spared(context: MissionContext, said: Refusal) -> Things | None:
    """What is not refused, if all else is; None if it is not said so.

    As in "forget all but the mug", "do not bring anything but the mug".
    """
    match things_in(context.interpreter.read(said.words)):
        case Things(members=[Thing(exceptions=left_out) as thing]) if (
            not thing.words or thing.pronoun
        ):
            return Things(left_out) if _named(context, Things(left_out)) else None
    return None


def _named(context: MissionContext, things: Things) -> set[str]:
    return named_in(context, " or ".join(thing.words for thing in things.members))


def nothing_else(context: MissionContext, things: Things, words: str, at_hand: Command) -> str:
    """Do only what is named, and drop all other tasks; or do it in place of all of them."""
    agenda = context.situation.agenda
    named = _named(context, things)
    if not named:
        number = number_alone(things)
        fewer = only_so_many(context, number, at_hand) if number else ""
        return fewer or f"{context.interpreter.not_understood(words)}."
    whole = agenda.whole_tasks
    waiting = [task for task in whole if named & objects_of(context, task.command)]
    wishes = [task.command for task in waiting]
    if not all(objects_of(context, one) <= named for one in wishes):
        return f"{context.interpreter.not_understood(words)}."
    for task in [task for task in whole if task not in waiting]:
        agenda.strike_out(task)
    if not objects_of(context, at_hand) <= named:  # the current task is not wanted any more
        if not waiting:
            return correct(context, Correction(things), words, "")
        agenda.take_back()
    else:
        wishes.insert(0, at_hand)
    return f"All right: I {in_one_breath(context, wishes)}, and nothing else."
