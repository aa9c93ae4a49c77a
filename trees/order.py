"""Which task comes next: in the order said, or, where none was said, in the cheapest."""

from dataclasses import replace
from itertools import chain, permutations

from executive.interfaces.knowledge import Knowledge
from executive.situation import Task
from executive.types.commands import ALL, Command, CommandKind
from trees.context import MissionContext
from trees.expected import Expected, is_in_hand
from trees.meant import things_meant
from trees.wholes import left_to_do, settle

WEIGHED = 5
"""So many tasks are put in order at once, those that take least: 120 orders are compared."""


def begin_next(context: MissionContext) -> bool:
    """Turn to the next task of the agenda; False if there is none."""
    situation = context.situation
    while settle(context):
        pass
    if not situation.agenda.tasks:
        return False
    task = cheapest(context, situation.agenda.next_ones())
    situation.begin(in_full(context, situation.agenda.take(task)))
    return True


def in_full(context: MissionContext, command: Command) -> Command:
    """The same about all of the things, if the words are for several, and there are.

    What is to be cleared may be a place or things, which only who knows their names can tell.
    """
    if command.kind == CommandKind.CLEAR:
        return _cleared(context.knowledge, command)
    several = command.plural and len(things_meant(context, command)) > 1
    return replace(command, number=ALL) if several else command


def _cleared(knowledge: Knowledge, command: Command) -> Command:
    """As in "clear the table in the kitchen", which is no thing, and "clear the mugs"."""
    target, source = command.target, command.source
    if target and not knowledge.objects_named(target) and knowledge.is_place(target):
        return replace(command, target="", source=f"{target} in {source}")
    names = [knowledge.objects_named(words) for words in source.split(" or ")]
    if target or not all(names) or knowledge.is_place(source):
        return command
    put = replace(command, kind=CommandKind.PUT_BACK, source="")
    things = tuple(dict.fromkeys(chain.from_iterable(names)))
    if len(things) == 1:
        return replace(put, target=things[0])
    target = source.replace(" or ", " and ")
    among = things if len(names) > 1 else ()
    return replace(put, target=target, number=len(things) if among else ALL, among=among)


def cheapest(context: MissionContext, tasks: tuple[Task, ...]) -> Task:
    """The task that the best order begins with; of orders that are as good, as they were said.

    What is in the hand comes first: it would be in the way. For the rest, the best order is over
    soonest, and so is each of its tasks, on the average; it has as many as are enough.
    """
    held = [task for task in tasks if is_in_hand(context, task.command)]
    if held or len(tasks) == 1:
        return (*held, *tasks)[0]
    expected, here = Expected(context), context.situation.dialogue.at
    from_here = sorted(tasks, key=lambda task: expected.seconds(task.command, here))[:WEIGHED]
    said_first = sorted(from_here, key=tasks.index)
    wanted = min(left_to_do(context, tasks), len(said_first))

    def cost(order: tuple[Task, ...]) -> float:
        ends = list(expected.done_after((task.command for task in order), here))
        return ends[-1] + sum(ends) / len(ends)

    return min(permutations(said_first, wanted), key=cost)[0]
