"""The tasks of a mission, one after the other: each has its own end; none is lost by another."""

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
    """A fallback that is gone through once for each task, going on within the same tick.

    At each tick it is heard first what the person says. Then its children find out what there is to
    do, if nothing is at hand. What is on the agenda when a task has ended is done next, whoever put
    it there meanwhile; what is to be done `instead` of the task at hand, or what is taken back,
    interrupts it, so that whatever it started is cancelled. A robot that cannot be reached any more
    ends them all: neither other places nor other tasks are tried.
    """

    def __init__(self, name: str, context: MissionContext, *ways: Behaviour) -> None:
        """`ways` are what is tried for each task, until one succeeds; the last one always does."""
        self._attend = hear_first(context)
        super().__init__(name, memory=True, children=[self._attend, stand_still(context), *ways])
        self._context = context

    def tick(self) -> Iterator[Behaviour]:
        """Tick the task at hand, and the next ones as long as they are decided."""
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
        """Say why nothing more can be done, once; what was under way has failed for that."""
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
        """Give up the task at hand; whether there is another."""
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
    """Of what was given up in the middle of a grasp, the fingers know more at rest."""
    agenda = context.situation.agenda
    return sequence(
        "stand still",
        Check("it was handling something", context, lambda: agenda.unsettled),
        ComeToRest("come to rest", context),
    )


def _handles(node: Behaviour) -> bool:
    return isinstance(node, Action) and node.is_under_way and node.activity == Activity.HANDLING
