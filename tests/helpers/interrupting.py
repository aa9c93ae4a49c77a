"""Something happens at a certain moment of a mission."""

from executive.events import Event, Inbox
from executive.interfaces.runtime import Clock


class Interrupting:
    """A Clock at which something happens at a certain time."""

    def __init__(self, clock: Clock, inbox: Inbox, time_s: float, event: Event) -> None:
        """Post the event then, once."""
        self._clock, self._inbox = clock, inbox
        self._time_s, self._event = time_s, event
        self.interrupted = False

    def now(self) -> float:
        """As ever."""
        return self._clock.now()

    def restart(self) -> None:
        """As ever."""
        self._clock.restart()

    def wait(self, deadline: float | None) -> None:
        """No longer than until then."""
        if self.interrupted:
            self._clock.wait(deadline)
            return
        self._clock.wait(self._time_s if deadline is None else min(deadline, self._time_s))
        if self.now() >= self._time_s:
            self.interrupted = True
            self._inbox.post(self._event)
