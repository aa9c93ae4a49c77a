"""Clocks of mission time: one for simulated worlds, one for real robots."""

import time

from executive.errors import ExecutiveError
from executive.events import Inbox
from executive.interfaces.simulation import World

PACE_S = 0.02
"""How often the world catches up with real time while somebody thinks and the robot moves."""
HANGING_S = 60.0
"""A computation that takes longer than this (real seconds) hangs; then mission time goes on."""


class SimulatedClock:
    """Runs as fast as the simulation while only the robot acts, in real time while a person thinks.

    It advances the world inside `wait`. While nothing moves, it sleeps until somebody answers; if
    nobody is asked, it jumps to the deadline.
    """

    def __init__(self, inbox: Inbox, world: World) -> None:
        """Start at 0."""
        self._inbox = inbox
        self._world = world
        self._now = 0.0

    def now(self) -> float:
        """The mission time (seconds)."""
        return self._now

    def restart(self) -> None:
        """Call this moment 0."""
        self._now = 0.0

    def wait(self, deadline: float | None) -> None:
        """Let time pass until an event is in the inbox or the deadline is reached.

        Time stands still while something is computed.

        Raises:
            ExecutiveError: if nothing is under way that could ever end the wait.
        """
        while self._goes_on(deadline):
            left = float("inf") if deadline is None else deadline - self._now
            if self._inbox.awaits_real:
                self._wait_in_real_time(left)
            elif self._world.busy:
                self._now += self._world.advance(left)
            elif deadline is not None:
                self._now = deadline
            else:
                raise ExecutiveError("the mission waits for nothing: no request, no deadline")

    def _goes_on(self, deadline: float | None) -> bool:
        """Finish all computations; return whether there is still neither event nor deadline."""
        while not self._inbox.await_computed(HANGING_S):
            self._now += HANGING_S
            if deadline is not None and self._now >= deadline:
                return False
        return not self._inbox.has_events and (deadline is None or self._now < deadline)

    def _wait_in_real_time(self, left: float) -> None:
        longest = min(left, PACE_S) if self._world.busy else left
        began = time.monotonic()
        self._inbox.wait(None if longest == float("inf") else longest)
        passed = time.monotonic() - began
        caught_up = 0.0
        while self._world.busy and caught_up < passed and not self._inbox.computes:
            caught_up += self._world.advance(passed - caught_up)
        self._now += passed


class RealClock:
    """Real time, for a real robot; it is read inside `wait`, so that it stands still in a tick."""

    def __init__(self, inbox: Inbox) -> None:
        """Start at 0."""
        self._inbox = inbox
        self.restart()

    def now(self) -> float:
        """The mission time (seconds)."""
        return self._now

    def restart(self) -> None:
        """Call this moment 0."""
        self._began, self._now = time.monotonic(), 0.0

    def wait(self, deadline: float | None) -> None:
        """Sleep until an event is in the inbox or the deadline is reached."""
        self._look()
        while not self._inbox.has_events and (deadline is None or self._now < deadline):
            self._inbox.wait(None if deadline is None else deadline - self._now)
            self._look()

    def _look(self) -> None:
        self._now = time.monotonic() - self._began
