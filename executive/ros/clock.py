"""Mission time of a robot whose own time is simulated."""

import time

from executive.clock import SimulatedClock
from executive.events import Inbox
from executive.ros.robot import WireRobot
from executive.ros.senses import Senses

PACE_S = 0.02
STANDING_S = 1.0
"""After so long in which the robot's clock is silent, or stands still, real time counts."""


class RobotClock:
    """Implements `Clock` by the robot's own, which goes on whether it acts or not."""

    def __init__(self, inbox: Inbox, senses: Senses) -> None:
        """Start at 0."""
        self._inbox = inbox
        self._senses = senses
        self.restart()

    def now(self) -> float:
        """The mission time (s)."""
        return self._now

    def restart(self) -> None:
        """Call this moment 0."""
        self._now = self._ahead = 0.0
        self._seen, self._looked = self._senses.elapsed, time.monotonic()

    def wait(self, deadline: float | None) -> None:
        """Sleep until an event is in the inbox or the deadline is reached."""
        self._look()
        while not self._inbox.has_events and (deadline is None or self._now < deadline):
            self._inbox.wait(PACE_S)
            self._look()

    def _look(self) -> None:
        """Count what has passed; what real time has counted already, the robot's does not again."""
        seen, looked = self._senses.elapsed, time.monotonic()
        if looked - self._senses.clock_went_on > STANDING_S:
            self._now += looked - self._looked
            self._ahead += looked - self._looked
        elif seen > self._seen:
            self._now += max(0.0, seen - self._seen - self._ahead)
            self._ahead = 0.0
        self._seen, self._looked = seen, looked


class GoalClock(SimulatedClock):
    """Implements `Clock` by the robot's own, as far as a goal is under way.

    So a simulated robot that runs as fast as it can has the same mission times as one in process.
    """

    def __init__(self, inbox: Inbox, robot: WireRobot) -> None:
        """Start at 0."""
        self._goals = GoalTime(inbox, robot)
        super().__init__(inbox, self._goals)

    def wait(self, deadline: float | None) -> None:
        """Let time pass until an event is in the inbox or the deadline is reached."""
        super().wait(deadline)
        self._now += self._goals.passed()


class GoalTime:
    """Implements `World`: the time of the robot's own that passes while a goal is under way."""

    def __init__(self, inbox: Inbox, robot: WireRobot) -> None:
        """No time has passed."""
        self._inbox = inbox
        self._robot = robot
        self._counted = 0.0

    @property
    def busy(self) -> bool:
        """Whether a goal is under way."""
        return self._robot.busy

    def advance(self, at_most: float) -> float:
        """Wait a little; how much of the robot's time has passed (s), which may be more."""
        self._inbox.wait(min(PACE_S, at_most))
        return self.passed()

    def passed(self) -> float:
        """How much of it has passed since this was asked last (s)."""
        before, self._counted = self._counted, self._robot.acted_s()
        return self._counted - before

    def close(self) -> None:
        """Nothing to free."""
