"""Which task comes next: in the order said, or, where none was said, the one that is nearest."""

import math

from executive.situation import Situation, Task
from executive.types import DELIVERY, PERSON, Command
from trees.context import MissionContext
from trees.object import meant
from trees.person import places_in


def begin_next(context: MissionContext) -> bool:
    """Turn to the next task of the agenda; False if there is none."""
    situation = context.situation
    if not situation.agenda.tasks:
        return False
    task = nearest(context, situation.agenda.next_ones())
    situation.begin(situation.agenda.take(task))
    return True


def nearest(context: MissionContext, tasks: tuple[Task, ...]) -> Task:
    """The task whose thing is nearest by what is known; of equals, the one said first."""
    here = robot_at(context.situation)

    def way_m(task: Task) -> float:
        there = expected_at(context, task.command)
        return context.distance(here, there) if there else math.inf

    return min(tasks, key=way_m) if len(tasks) > 1 else tasks[0]


def expected_at(context: MissionContext, command: Command) -> str:
    """Where the thing of a task most likely is, as far as nobody has to be asked; or nothing."""
    if named := places_in(context, command.source):
        return named[0]
    objects = meant(context.knowledge, command)
    if len(objects) != 1:
        return ""
    [name] = objects
    believed = (*context.facts.places_of(name), *context.knowledge.usual_places(name))
    return next((p for p in believed if p == DELIVERY or context.knowledge.has_place(p)), "")


def robot_at(situation: Situation) -> str:
    """The place that the robot went to last, as far as this task tells; else the person."""
    if not situation.dialogue.away:
        return PERSON
    return situation.hand.put_at or next(reversed(situation.search.looks.visited), PERSON)
