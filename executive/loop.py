"""The executive: events in, ticks out. The only caller of `tick()`."""

import logging
import time
import traceback

from executive.errors import ExecutiveError
from executive.events import DeadlinePassed, Inbox
from executive.interfaces import Clock, Recorder, Robot, Tree
from executive.records import EventTaken, LlmCall, Note, Tick
from executive.situation import Situation
from executive.types import Halt, Replied, Scored, Status

log = logging.getLogger(__name__)

REST_S = 5.0
"""How long the robot may take to come to rest (mission time, s)."""


class Executive:
    """Runs one mission: take all events, fold them into the situation, tick once, wait.

    No event and no deadline, no tick: while a person or a model thinks, nothing runs.
    """

    def __init__(
        self,
        tree: Tree,
        situation: Situation,
        *,
        inbox: Inbox,
        clock: Clock,
        robot: Robot,
        recorder: Recorder,
    ) -> None:
        """Put the parts together; `run` starts."""
        self._tree = tree
        self._situation = situation
        self._inbox = inbox
        self._clock = clock
        self._robot = robot
        self._recorder = recorder
        self.ticks = 0

    def run(self) -> None:
        """Tick until the tree has decided or someone says stop; leave the robot at rest.

        A behaviour that raises ends the mission as not done: what it raised goes to the log.
        """
        self._recorder.record(self._tree.shape())
        finished = False
        try:
            finished = self._run_until_decided()
        except Exception as error:
            self._give_up(error)
        finally:
            self._tree.stop()
            if not finished:
                self._come_to_rest()

    def _run_until_decided(self) -> bool:
        while True:
            cause = self._take_events()
            if self._situation.stopped_by:
                return False
            self._tick(cause)
            if self._tree.status != "RUNNING":
                return True
            self._clock.wait(self._situation.next_deadline)

    def _take_events(self) -> str:
        """Fold what happened into the situation; say what it was."""
        events = self._inbox.take_all() or (DeadlinePassed(self._clock.now()),)
        for event in events:
            self._situation.fold(event)
            self._recorder.record(EventTaken(event))
            result = getattr(event, "result", None)
            if isinstance(result, Replied | Scored):
                self._recorder.record(LlmCall(result))
        return ", ".join(type(getattr(e, "result", e)).__name__ for e in events)

    def _tick(self, cause: str) -> None:
        began = time.perf_counter()
        self._tree.tick()
        self._recorder.record(
            Tick(
                number=self.ticks,
                cause=cause,
                tip=self._tree.tip,
                nodes=self._tree.states(),
                situation=self._situation.snapshot(),
                duration_s=time.perf_counter() - began,
            )
        )
        self.ticks += 1

    def _give_up(self, error: Exception) -> None:
        self._situation.status = Status.NOT_DONE
        if isinstance(error, ExecutiveError):
            self._situation.reason = str(error)
            return
        self._situation.reason = f"internal error: {type(error).__name__}: {error}"
        log.debug("a behaviour raised", exc_info=error)
        self._recorder.record(Note("error", "".join(traceback.format_exception(error))))

    def _come_to_rest(self) -> None:
        """Stop the robot and let time pass until it stands still."""
        request = self._robot.start(Halt())
        latest = self._clock.now() + REST_S
        while self._inbox.is_open(request) and self._clock.now() < latest:
            self._clock.wait(latest)
            for event in self._inbox.take_all():
                self._recorder.record(EventTaken(event))
