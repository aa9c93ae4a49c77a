"""Corrections: of the current task, of one that waits, or of all tasks of the same sentence.

In these functions `at_hand` is the current task, `words` what the person said just now, and `now`
a sentence that says what the robot is doing. Each returns the answer to the person.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

from executive.language.corrections import corrected
from executive.language.meaning import ME, Correction, Request, Thing, Things
from executive.language.pronouns import with_names
from executive.types.commands import ALL, Command, Commands
from trees.at_hand import of_all_spoken
from trees.context import MissionContext
from trees.taken_back import refused
from trees.telling import in_one_breath
from trees.wishes import added, named_in, objects_of, replaced


def correct(
    context: MissionContext, said: Correction, words: str, now: str, instead: str = " instead"
) -> str:
    """Change the current task, a waiting one, or add one, as the correction asks for.

    Args:
        context: its agenda is changed.
        said: the correction, as it was understood.
        words: what the person said.
        now: what the robot is doing, as a sentence.
        instead: ends the answer if another task takes the place of the current one.
    """
    at_hand = context.situation.agenda.whole_of(context.situation.request.command)
    assert at_hand
    spoken = of_all_spoken(context.situation, said.meant)
    if (but := _all_but_these(context, said, at_hand)) and (less := refused(context, but, at_hand)):
        return less
    if changed := _correct_later(context, said, at_hand, words):
        return changed
    if said.left_out and not _is_goal(context, said.left_out, at_hand):
        return _less(context, said, at_hand, words, now)
    commands = corrected(with_names(said, spoken), at_hand, words)
    if said.adds or not isinstance(commands, tuple):
        return added(context, commands, now)
    commands = (*commands, *_likewise(context, said, at_hand, commands, words))
    return replaced(context, commands, instead)


def _all_but_these(context: MissionContext, said: Correction, at_hand: Command) -> str:
    """What is to be left of all that was asked for: "no, all but the pear"; empty if it is not so.

    Of a kind that was asked for, "all but the pear" are the others of that kind.
    """
    match said.meant:
        case Things(members=[Thing(words="", number=number, exceptions=left_out)]) if number == ALL:
            words = " and ".join(but.words for but in left_out)
        case _:
            return ""
    named, waiting = named_in(context, words), context.situation.agenda.whole_tasks
    wanted = (objects_of(context, one) for one in (at_hand, *(task.command for task in waiting)))
    return words if any(set() < things <= named for things in wanted) else ""


def _is_goal(context: MissionContext, left_out: Sequence[Thing], at_hand: Command) -> bool:
    """Whether what is left out is the current goal: "on the sofa, not the desk"."""
    places = context.knowledge.places_named
    named = {place for but in left_out for place in places(but.words)}
    return bool(named) and named <= {*places(at_hand.goal)}


def _less(context: MissionContext, said: Correction, at_hand: Command, words: str, now: str) -> str:
    """Do what the correction says, without what it leaves out: "to the desk, but not the pear"."""
    agenda, left_out = context.situation.agenda, " and ".join(but.words for but in said.left_out)
    rest = replace(said, left_out=())
    if not (without := refused(context, left_out, at_hand)):
        if all(named_in(context, but.words) for but in said.left_out):  # no task is about it
            return correct(context, rest, words, now)
        return f"{context.interpreter.not_understood(words)}. {now}"
    if agenda.taken_back:
        agenda.go_on_with(others := _likewise(context, rest, at_hand, (), words))
        others_so = in_one_breath(context, chain.from_iterable(others))
        return f"{without} All right: I {others_so}." if others else without
    among = tuple(sorted(named_in(context, left_out) & objects_of(context, at_hand)))
    narrower = replace(at_hand, exceptions=(*at_hand.exceptions, *among))
    commands = corrected(rest, narrower, words)
    if isinstance(commands, str):
        return f"{without} {commands}"
    return replaced(context, (*commands, *_likewise(context, rest, narrower, commands, words)))


def _likewise(
    context: MissionContext, said: Correction, at_hand: Command, commands: Commands, words: str
) -> Commands:
    """The waiting tasks of the same sentence, corrected likewise: they all go elsewhere.

    They leave the agenda, and so do waiting tasks about things that `commands`, the corrected
    current task, already asks for.
    """
    agenda, asked_anew = context.situation.agenda, [*chain.from_iterable(commands)]
    things = {name for one in asked_anew for name in objects_of(context, one)}
    changed: list[tuple[Command, ...]] = []
    whole = agenda.whole_tasks
    sentence = [at_hand, *(t.command for t in whole if t.command.words == at_hand.words)]
    wanted = {name for one in sentence for name in objects_of(context, one)}
    only_these = len(asked_anew) > 1 and things <= wanted  # "no, the mug and the pear", of three
    for task in whole:
        command = task.command
        asked_again = set() < objects_of(context, command) <= things
        alike = (command.words, command.kind, command.goal)
        if said.meant is None and alike == (at_hand.words, at_hand.kind, at_hand.goal):
            if isinstance(others := corrected(said, command, words), tuple):
                agenda.tasks.remove(task)
                changed += others
        elif command.words == at_hand.words and isinstance(said.meant, Things):
            if asked_again:
                agenda.tasks.remove(task)
            elif only_these:
                agenda.strike_out(task)
        elif asked_again:
            agenda.tasks.remove(task)
    return tuple(changed)


def _correct_later(context: MissionContext, said: Correction, at_hand: Command, words: str) -> str:
    """Change a waiting task if the correction is about it; else the answer is empty.

    It is if its thing is not meant ("the pear, not the apple"), or is to go elsewhere ("no, the
    pear to the desk").
    """
    agenda, meant = context.situation.agenda, said.wrong or _to_go_elsewhere(said)
    named = " or ".join(thing.words for thing in meant.members) if meant else ""
    if not (wrong := named_in(context, named)) or wrong & objects_of(context, at_hand):
        return ""
    task = next((one for one in agenda.tasks if wrong & objects_of(context, one.command)), None)
    commands = corrected(replace(said, wrong=None), task.command, words) if task else ""
    if not task or not isinstance(commands, tuple):
        return ""
    [[command], *others] = commands
    wanted = [at_hand, *(one.command for one in agenda.tasks if one is not task)]
    if not others and any(_asks_for_the_same(context, command, one) for one in wanted):
        agenda.strike_out(task)
        return f"Then I do not {in_one_breath(context, (task.command,))}."
    agenda.change(task, command)
    agenda.add(others)
    return f"All right: I {in_one_breath(context, chain.from_iterable(commands))} instead."


def _asks_for_the_same(context: MissionContext, command: Command, other: Command) -> bool:
    """Whether both commands have the same kind, goal and things, so that one is enough."""
    same = (command.kind, command.goal) == (other.kind, other.goal)
    return same and objects_of(context, command) == objects_of(context, other)


def _to_go_elsewhere(said: Correction) -> Things | None:
    """The things of a correction that names a goal for them; None if it does not."""
    match said.meant:
        case Request(tasks=[task]) if task.goal not in (None, ME):
            return task.things
    return None


def all_of(
    context: MissionContext, names: Sequence[str], words: str, *, one_of: bool = False
) -> str:
    """Do the current task with each of these things, or with `one_of` them, the fastest.

    They are the answer to the question which one is meant.
    """
    at_hand = context.situation.agenda.whole_of(context.situation.request.command)
    assert at_hand
    things = (context.say.words(name) for name in names)
    meant = Things(tuple(Thing(thing, definite=True, said=thing) for thing in things), one_of)
    commands = corrected(Correction(meant), at_hand, words)
    if isinstance(commands, str):
        return commands
    said = replaced(context, commands, "")
    return "All right: I choose the one that takes least time." if one_of else said
