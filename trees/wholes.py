"""A task that is done in parts: when it is settled, and what is told of it."""

from collections.abc import Sequence
from dataclasses import replace

from executive.language.wording import listed
from executive.situation import Task, Whole
from executive.types import Command, CommandKind, MissionStatus, TaskOutcome
from trees.context import MissionContext
from trees.deeds import deed_of
from trees.telling import tell, to_where

NUMBERS = ("none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def settle(context: MissionContext) -> bool:
    """End the task that is done in parts, if it is settled, and tell what came of it."""
    agenda = context.situation.agenda
    if not agenda.wholes:
        return False
    whole = agenda.wholes[-1]
    if whole.command.conditional:
        decide(context, whole)
    if agenda.has_parts and (whole.command.conditional or len(whole.done) < most(whole)):
        return False
    agenda.drop_parts()
    agenda.wholes.pop()
    agenda.end(outcome_of(context, whole))
    return True


def most(whole: Whole) -> int:
    """How many parts can be done: one hand takes one thing."""
    return 1 if whole.command.kind == CommandKind.TAKE else whole.wanted


def left_to_do(context: MissionContext, tasks: Sequence[Task]) -> int:
    """How many of the tasks that may come next are to be done: of parts, as many as are enough."""
    wholes = context.situation.agenda.wholes
    if not (wholes and tasks[0].depth == len(wholes)):
        return len(tasks)
    return min(most(wholes[-1]) - len(wholes[-1].done), len(tasks))


def decide(context: MissionContext, whole: Whole) -> None:
    """Of a condition: what follows from the part that has ended."""
    agenda, command = context.situation.agenda, whole.command
    if len(whole.parts) != 1 or agenda.has_parts:
        return
    [last] = whole.parts
    if command.sought:
        seen = bool(last.things) or last.location is not None
        holds = seen if last.status == MissionStatus.DONE else None
    else:
        holds = last.status == MissionStatus.DONE or last.location is not None
    if holds and command.sought:
        agenda.go_on_with(((what_follows(command, last),),))
    elif holds is False and command.unless:
        agenda.go_on_with(((command.unless,),))


def what_follows(command: Command, answer: TaskOutcome) -> Command:
    """The deed, with the thing that was seen if it was about such a thing, and where that is."""
    deed = without_condition(command)
    if answer.location:  # of what it is to be put beside
        return replace(deed, goal=answer.location)
    if command.sought and deed.target == command.sought.target:
        return replace(deed, target=answer.things[0], purpose="", number=0)
    return deed


def without_condition(command: Command) -> Command:
    """The deed itself."""
    return replace(command, conditional=False, sought=None, unless=None)


def outcome_of(context: MissionContext, whole: Whole) -> TaskOutcome:
    """What came of the whole; told, if its parts alone do not tell it."""
    command, last = whole.command, whole.parts[-1]
    wanted = max(whole.wanted, command.number)
    if command.conditional or wanted == 1:
        done = last.status == MissionStatus.DONE
        reason = last.reason if done else sentences(whole.parts)
    else:
        done = len(whole.done) >= wanted
        reason = how_many(context, whole, wanted)
        tell(context, reason)
    return TaskOutcome(
        kind=command.kind,
        target=command.target,
        object=last.object,
        status=MissionStatus.DONE if done else MissionStatus.NOT_DONE,
        reason=reason,
        location=last.location,
        goals=last.goals,
        visited=tuple(place for part in whole.parts for place in part.visited),
        parts=tuple(whole.parts),
    )


def sentences(parts: list[TaskOutcome]) -> str:
    """Why each of them was not done."""
    return "; ".join(dict.fromkeys(part.reason.rstrip(".") for part in parts))


def how_many(context: MissionContext, whole: Whole, wanted: int) -> str:
    """Of how many it was done, of which, and why not of the others."""
    command, done = whole.command, len(whole.done)
    if done == wanted:
        count, why = "both" if wanted == 2 else f"all {number(wanted)}", ""
    else:
        one_hand = command.kind == CommandKind.TAKE
        count = f"{number(done)} of {number(wanted)}"
        why = "I can hold one thing at a time" if one_hand else "I know of no more"
        why = sentences([p for p in whole.parts if p.status != MissionStatus.DONE]) or why
    did = filter(None, ("I", deed_of(command.kind).did, count, to_where(context, command)))
    which = listed([context.say.the(part.object or part.target) for part in whole.done])
    return " ".join(did) + f": {which}" * bool(which) + f"; {why}" * bool(why) + "."


def number(count: int) -> str:
    """A small number in letters."""
    return NUMBERS[count] if count < len(NUMBERS) else str(count)
