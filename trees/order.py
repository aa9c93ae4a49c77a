"""Which task comes next: in the order said, or, where none was said, the one that is nearest."""

import math

from executive.situation import Task
from executive.types import DELIVERY, Command
from trees.context import MissionContext
from trees.meant import meant, robot_at
from trees.person import places_in
from trees.wholes import settle


def begin_next(context: MissionContext) -> bool:
    """Turn to the next task of the agenda; False if there is none."""
    situation = context.situation
    while settle(context):
        pass
    if not situation.agenda.tasks:
        return False
    task = nearest(context, situation.agenda.next_ones())
    situation.begin(situation.agenda.take(task))
    return True


def nearest(context: MissionContext, tasks: tuple[Task, ...]) -> Task:
    """The task whose thing is nearest by what is known; of equals, the one said first."""
    if len(tasks) == 1:
        return tasks[0]
    here = robot_at(context.situation)

    def way_m(task: Task) -> float:
        places = expected_at(context, task.command)
        return min((context.distance(here, place) for place in places), default=math.inf)

    return min(tasks, key=way_m)


def expected_at(context: MissionContext, command: Command) -> tuple[str, ...]:
    """Where the thing of a task may well be, as far as nobody has to be asked."""
    if named := places_in(context, command.source):
        return named
    objects = meant(context.knowledge, command)
    if len(objects) != 1:
        return ()
    [name] = objects
    believed = context.facts.places_of(name)[:1] or context.knowledge.usual_places(name)
    return tuple(p for p in believed if p == DELIVERY or context.knowledge.has_place(p))
