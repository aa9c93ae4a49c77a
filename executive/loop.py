"""The executive: events in, ticks out. The only caller of `tick()`."""

import logging
import time

from executive.errors import ExecutiveError
from executive.events import (
    Broke,
    DeadlinePassed,
    Ended,
    Event,
    HandFelt,
    Inbox,
    Intervened,
    StopRequested,
)
from executive.guards import WHOLE, GuardedRecorder, GuardedRobot, in_words, traceback_of
from executive.interfaces.robot import Robot
from executive.interfaces.runtime import Clock, Recorder, Tree
from executive.language.wording import WITHOUT_KNOWLEDGE
from executive.pending import Pending
from executive.records import EventTaken, Intervention, LlmCall, Note, Tick
from executive.situation import Situation
from executive.text import printable
from executive.types.goals import Halt
from executive.types.results import Failed, Replied, Result, Scored, Succeeded

log = logging.getLogger(__name__)

REST_S = 5.0
"""How long the robot may take to come to rest (mission time, s)."""
HALTS = 3
"""How often a failed halt is tried, and how many failures of the clock each try tolerates."""


class Executive:
    """Runs one mission: take all events, fold them into the situation, tick once, wait.

    No event and no deadline, no tick: while a person or a model thinks, nothing runs.
    """

    def __init__(
        self,
        tree: Tree,
        situation: Situation,
        *,
        pending: Pending,
        inbox: Inbox,
        clock: Clock,
        robot: Robot,
        recorder: Recorder,
    ) -> None:
        """Connect the parts; `run` starts the mission.

        `pending` holds the open requests and deadlines of this tree's behaviours, and no others.
        """
        self._tree = tree
        self._situation = situation
        self._pending = pending
        self._inbox = inbox
        self._clock = clock
        self._robot = GuardedRobot(robot, inbox, recorder)
        self._recorder = GuardedRecorder(recorder)
        self.ticks = 0
        self.stops: list[StopRequested] = []
        """All requests to stop, in order, including those that came after the tree had decided."""

    def run(self) -> None:
        """Tick until the tree has decided or someone says stop; leave the robot at rest.

        An exception ends the mission as not done, and its traceback goes to the log. In the end,
        no request is open, and the situation says how the mission ended.

        Raises:
            KeyboardInterrupt: this, and whatever else is not an `Exception`, is passed on after
                the robot was told to halt.
        """
        try:
            decided = self._decide()
            self._call_off()
            if not decided or self._situation.ending.restless:
                self._come_to_rest()
        except BaseException as interrupt:
            self._take_in(StopRequested(who_interrupts(interrupt)))
            self._situation.ending.stay_restless()
            try:
                self._call_off()
            finally:
                self._robot.start(Halt())
            raise
        finally:
            self._inbox.drop_all()
            self._take_all()

    # --- the mission ---

    def _decide(self) -> bool:
        """Run the mission; return whether the tree has decided (else it was cut short)."""
        try:
            self._recorder.record(self._tree.shape())
            self._feel()
            return self._run_until_decided()
        except Exception as error:
            self._note(error)
            known = isinstance(error, ExecutiveError)
            reason = in_words(error) if known else f"internal error: {in_words(error)}"
            self._take_in(Broke(reason))
            return False

    def _run_until_decided(self) -> bool:
        while True:
            cause = self._take_events()
            if self._situation.ending.is_cut_short:
                return False
            self._tick(cause)
            if self._tree.status != "RUNNING":
                self._situation.ending.decided = True
                return True
            self._clock.wait(self._pending.next_deadline)

    def _take_events(self) -> str:
        """Fold all new events into the situation; return their names, the cause of the tick."""
        events = self._take_all()
        if not events:
            events = (DeadlinePassed(self._clock.now()),)
            self._take_in(*events)
            self._feel()  # an action that runs out of time may already have moved the hand
        elif any(_may_change_the_hand(event) for event in events):
            self._feel_at_rest()
        woke = (event for event in events if not isinstance(event, HandFelt))
        return ", ".join(type(getattr(e, "result", e)).__name__ for e in woke)

    def _take_all(self) -> tuple[Event, ...]:
        events = self._inbox.take_all()
        for event in events:
            self._take_in(event)
        return events

    def _take_in(self, event: Event) -> None:
        if isinstance(event, Ended):
            self._pending.end(event.request, event.result)
        self._situation.fold(event)
        self._recorder.record(EventTaken(event))
        if isinstance(event, StopRequested):
            self.stops.append(event)
        if isinstance(event, Intervened):
            told = Intervention(event.by, event.deed, event.was, event.became)
            self._recorder.record(told)
        result = getattr(event, "result", None)
        if isinstance(result, Replied | Scored):
            self._recorder.record(LlmCall(result))

    def _feel_at_rest(self) -> None:
        """Ask the fingers what they hold, unless some request is still open."""
        if not self._inbox.awaits_anything:
            self._feel()

    def _feel(self) -> None:
        """Ask the fingers what they hold; a change is an event."""
        holding = self._robot.holding
        if holding != self._situation.hand.felt:
            self._take_in(HandFelt(holding))

    def _tick(self, cause: str) -> None:
        """Tick the tree, and record it; if it raises, undo what it changed in the situation.

        A tick that raised is not recorded. Undoing it keeps the situation equal to what a replay
        of the record computes.
        """
        before = self._situation.saved()
        try:
            record = self._tick_tree(cause)
        except BaseException:
            self._situation.restore(before)
            raise
        self._recorder.record(record)
        self.ticks += 1

    def _tick_tree(self, cause: str) -> Tick:
        began = time.perf_counter()
        self._tree.tick()
        return Tick(
            number=self.ticks,
            cause=cause,
            tip=self._tree.tip,
            nodes=self._tree.states(),
            situation=self._situation.snapshot() | {"deadlines": self._pending.deadlines()},
            duration_s=time.perf_counter() - began,
        )

    # --- the end of the mission ---

    def _call_off(self) -> None:
        """Stop the tree, so that every behaviour cancels what it started."""
        try:
            self._tree.stop()
        except Exception as error:
            self._note(error)

    def _come_to_rest(self) -> None:
        """Halt the robot; if it may still be moving after that, the situation says so."""
        result: Result | None = None
        for _ in range(HALTS):
            result = self._halt()
            if not isinstance(result, Failed):
                break
        if isinstance(result, Succeeded):
            self._situation.ending.restless = False
        else:
            why = result.reason if isinstance(result, Failed) else ""
            self._situation.ending.stay_restless(printable(why)[:WHOLE])
        self._inbox.drop_all()
        self._feel()
        held = self._situation.hand.in_hand
        if held and self._situation.ending.is_cut_short:
            self._situation.ending.hold_on_to(WITHOUT_KNOWLEDGE.the(held))

    def _halt(self) -> Result | None:
        """Tell the robot to halt, and wait; return its result, or None if it took too long."""
        request = self._robot.start(Halt())
        latest, failures = self._clock.now() + REST_S, 0
        while self._inbox.is_open(request) and self._clock.now() < latest and failures < HALTS:
            try:
                self._clock.wait(latest)
            except Exception as error:
                self._note(error)
                failures += 1
            self._take_all()
        return self._pending.take_end(request)

    def _note(self, error: Exception) -> None:
        log.debug("the mission is cut short", exc_info=error)
        self._recorder.record(Note("error", traceback_of(error)))


def who_interrupts(interrupt: BaseException) -> str:
    """The name under which an interrupt is recorded as a request to stop."""
    return "Ctrl-C" if isinstance(interrupt, KeyboardInterrupt) else type(interrupt).__name__


def _may_change_the_hand(event: Event) -> bool:
    """Whether the event may be the end of a movement, which may have changed what is held."""
    return isinstance(event, Ended) and isinstance(event.result, Succeeded | Failed)
