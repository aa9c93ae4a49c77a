"""A task that is done in parts: when it ends, and with what outcome."""

from collections.abc import Sequence
from dataclasses import replace

from executive.situation import Task, Whole
from executive.types.commands import Command, CommandKind
from executive.types.outcome import MissionStatus, TaskOutcome
from trees.context import MissionContext
from trees.how_many import how_many, sentences
from trees.telling import tell


def settle(context: MissionContext) -> bool:
    """End the innermost task in parts if it is decided, and tell the outcome; whether it ended."""
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
    """How many parts can be done: for "take", one, because there is one hand."""
    return 1 if whole.command.kind == CommandKind.TAKE else whole.wanted


def left_to_do(context: MissionContext, tasks: Sequence[Task]) -> int:
    """How many of the next tasks are to be done; parts of a task only until enough are done."""
    wholes = context.situation.agenda.wholes
    if not (wholes and tasks[0].depth == len(wholes)):
        return len(tasks)
    return min(most(wholes[-1]) - len(wholes[-1].done), len(tasks))


def decide(context: MissionContext, whole: Whole) -> None:
    """For a task with a condition: add what follows from the outcome of its first part."""
    agenda, command = context.situation.agenda, whole.command
    if len(whole.parts) != 1 or agenda.has_parts:
        return
    [last] = whole.parts
    if command.sought or command.kind == CommandKind.CHECK:
        seen = bool(last.things) or last.location is not None
        holds = seen if last.status == MissionStatus.DONE else None
    else:
        holds = last.status == MissionStatus.DONE or last.location is not None
    if holds and command.sought:
        agenda.go_on_with(((what_follows(command, last),),))
    elif holds is False and command.unless:
        agenda.go_on_with(((command.unless,),))


def what_follows(command: Command, answer: TaskOutcome) -> Command:
    """The deed without its condition, with the thing or at the place that was seen."""
    deed = without_condition(command)
    if answer.location:  # of what it is to be put beside
        return replace(deed, goal=answer.location)
    if command.sought and deed.target == command.sought.target:
        return replace(deed, target=answer.things[0], purpose="", number=0)
    return deed


def without_condition(command: Command) -> Command:
    """The deed without its condition."""
    return replace(command, conditional=False, sought=None, unless=None)


def outcome_of(context: MissionContext, whole: Whole) -> TaskOutcome:
    """The outcome of the whole task; told, unless the parts have already told it."""
    command = whole.command
    last = (whole.parts if command.conditional else whole.done or whole.parts)[-1]
    wanted = max(whole.wanted, command.number)
    if command.conditional or (wanted == 1 and not whole.unseen):
        done = last.status == MissionStatus.DONE
        reason = last.reason if done else sentences(whole.parts)
    else:
        done = len(whole.done) >= wanted and not whole.unseen
        reason = how_many(context, whole, wanted)
        tell(context, reason)
    return TaskOutcome(
        kind=command.kind,
        target=command.target,
        object=last.object,
        status=MissionStatus.DONE if done else MissionStatus.NOT_DONE,
        reason=reason,
        location=last.location,
        put_at=last.put_at,
        goals=last.goals,
        visited=tuple(place for part in whole.parts for place in part.visited),
        parts=tuple(whole.parts),
    )
