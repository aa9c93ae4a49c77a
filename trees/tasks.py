"""The tasks of a mission, one after the other; each has an outcome, and none is lost."""

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
    """A fallback that runs once for each task, and goes on to the next task within the same tick.

    Each tick first hears the person. Then, if there is no task, the children find out what to do.
    The agenda decides what comes next, whoever has added to it. A task is interrupted if it is
    taken back, or if something is to be done `instead`: all that it started is cancelled. If the
    robot becomes unreachable, all tasks end, and nothing else is tried.
    """

    def __init__(self, name: str, context: MissionContext, *ways: Behaviour) -> None:
        """`ways` are tried in order for each task, until one succeeds; the last one always does."""
        self._attend = hear_first(context)
        super().__init__(name, memory=True, children=[self._attend, stand_still(context), *ways])
        self._context = context

    def tick(self) -> Iterator[Behaviour]:
        """Tick the current task; whenever one is done, go on to the next one."""
        agenda = self._context.situation.agenda
        if self.status == Status.RUNNING:
            yield from self._attend.tick()
        while True:
            if self._context.situation.ending.unreachable:
                self._end_for_good()
                yield self
                return
            if agenda.interrupts and not self._goes_on():
                self.status = Status.SUCCESS
                yield self
                return
            yield from super().tick()
            if agenda.interrupts:  # by an answer
                continue
            if self.status == Status.RUNNING:
                return
            self._context.situation.end_task()
            if not begin_next(self._context):
                self._context.situation.conclude()
                return

    def _end_for_good(self) -> None:
        """End all tasks with the reason, told once; open actions note it as their failure."""
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

    def _goes_on(self) -> bool:
        """Interrupt the current task and begin the next one; False if there is none."""
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
    """After an interrupted grasp, stop the robot: at rest, the fingers tell what they hold."""
    agenda = context.situation.agenda
    return sequence(
        "stand still",
        Check("it was handling something", context, lambda: agenda.unsettled),
        ComeToRest("come to rest", context),
    )


def _handles(node: Behaviour) -> bool:
    return isinstance(node, Action) and node.is_under_way and node.activity == Activity.HANDLING
