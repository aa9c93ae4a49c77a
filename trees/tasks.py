"""The tasks of a mission, one after another; each has an outcome of its own."""

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Activity
from executive.situation import TAKEN_BACK
from executive.types.outcome import MissionStatus
from trees.attend import hear_first
from trees.body import BodyAction
from trees.context import MissionContext
from trees.handling import ComeToRest
from trees.nodes import Action, Check, Selector, sequence
from trees.order import begin_next, in_full
from trees.telling import sentence, tell


class EachTask(Selector):
    """A fallback that runs once for each task; it goes on to the next task within the same tick.

    Each tick begins with what the person has said. When a task has ended, the next one on the
    agenda begins, also if it was put there meanwhile. A task that is replaced or taken back is
    interrupted, which cancels all that it started. If the robot cannot be reached any more, that
    ends all tasks: no other place and no other task is tried.
    """

    def __init__(self, name: str, context: MissionContext, *ways: Behaviour) -> None:
        """`ways` are tried for each task until one succeeds; the last one must always succeed."""
        self._attend = hear_first(context)
        super().__init__(name, memory=True, children=[self._attend, stand_still(context), *ways])
        self._context = context

    def tick(self) -> Iterator[Behaviour]:
        """Tick the current task; whenever it is done, go on to the next one."""
        agenda = self._context.situation.agenda
        if self.status == Status.RUNNING:
            yield from self._attend.tick()
        while True:
            if self._context.situation.ending.unreachable:
                self._end_for_good()
                yield self
                return
            if agenda.interrupts and not self._give_up_task():
                self.status = Status.SUCCESS
                yield self
                return
            yield from super().tick()
            if agenda.interrupts:  # by an answer to a question of the task
                continue
            if self.status == Status.RUNNING:
                return
            self._context.situation.end_task()
            if not begin_next(self._context):
                self._context.situation.conclude()
                return

    def _end_for_good(self) -> None:
        """End all tasks because the robot cannot be reached, and tell the person why."""
        situation = self._context.situation
        for node in self.iterate():
            if isinstance(node, BodyAction) and node.is_under_way:
                node.note_failure(situation.ending.unreachable)
        self.stop(Status.INVALID)
        self.status = Status.SUCCESS
        situation.ending.status = MissionStatus.NOT_DONE
        situation.ending.tell(situation.ending.unreachable)
        tell(self._context, sentence(f"Sorry: {situation.ending.why}"))
        situation.end_task()

    def _give_up_task(self) -> bool:
        """Interrupt the current task, and begin the next; return whether there is one."""
        situation = self._context.situation
        agenda = situation.agenda
        agenda.unsettled |= any(map(_handles, self.iterate()))
        self.stop(Status.INVALID)
        if instead := agenda.instead:
            agenda.instead, agenda.taken_back = None, False
            situation.begin(in_full(self._context, instead))
            return True
        agenda.taken_back = False
        situation.ending.status = MissionStatus.NOT_DONE
        situation.ending.tell(TAKEN_BACK)
        situation.end_task()
        if begin_next(self._context):
            return True
        situation.conclude()
        return False


def stand_still(context: MissionContext) -> Behaviour:
    """Halt if a task was given up during a grasp, so that the fingers tell what they hold."""
    agenda = context.situation.agenda
    return sequence(
        "stand still",
        Check("it was handling something", context, lambda: agenda.unsettled),
        ComeToRest("come to rest", context),
    )


def _handles(node: Behaviour) -> bool:
    return isinstance(node, Action) and node.is_under_way and node.activity == Activity.HANDLING
