"""The tasks of a mission, one after the other: each has its own end; none is lost by another."""

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from trees.context import MissionContext
from trees.nodes import Selector
from trees.order import begin_next


class EachTask(Selector):
    """A fallback that is gone through once for each task, going on within the same tick.

    Its children find out first what there is to do, if nothing is at hand. What is on the agenda
    when a task has ended is done next, whoever put it there meanwhile; what is to be done `instead`
    of the task at hand interrupts it, so that whatever it started is cancelled.
    """

    def __init__(self, name: str, context: MissionContext, *ways: Behaviour) -> None:
        """`ways` are what is tried for each task, until one succeeds; the last one always does."""
        super().__init__(name, memory=True, children=list(ways))
        self._context = context

    def tick(self) -> Iterator[Behaviour]:
        """Tick the task at hand, and the next ones as long as they are decided."""
        situation = self._context.situation
        if (instead := situation.agenda.instead) and self.status == Status.RUNNING:
            self.stop(Status.INVALID)
            situation.agenda.instead = None
            situation.begin(instead)
        while True:
            yield from super().tick()
            if self.status == Status.RUNNING:
                return
            situation.end_task()
            if not begin_next(self._context):
                situation.conclude()
                return
