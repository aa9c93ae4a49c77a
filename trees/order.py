"""Which task is next: by the order that was said, or, if none was said, by the expected time."""

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
"""At most so many tasks, the shortest ones, are put in order: that compares 120 orders."""


def begin_next(context: MissionContext) -> bool:
    """Begin the next task of the agenda; False if there is none."""
    situation = context.situation
    while settle(context):
        pass
    if not situation.agenda.tasks:
        return False
    task = cheapest(context, situation.agenda.next_ones())
    situation.begin(in_full(context, situation.agenda.take(task)))
    return True


def in_full(context: MissionContext, command: Command) -> Command:
    """The command for all its things if the words are plural and several things fit.

    "Clear" may be about a place or about things; this needs the known names.
    """
    if command.kind == CommandKind.CLEAR:
        return _cleared(context.knowledge, command)
    several = command.plural and len(things_meant(context, command)) > 1
    return replace(command, number=ALL) if several else command


def _cleared(knowledge: Knowledge, command: Command) -> Command:
    """The place of "clear the table in the kitchen" as source; "clear the mugs" as "put back"."""
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
    """The first task of the best order; between equal orders, the one that was said.

    A task with the held thing comes first, as the hand has to be free for the others. The best
    order has the least cost: the time until all is done, plus the mean time until a task is done.
    If a number of parts is enough, an order has only so many.
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
