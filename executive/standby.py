"""Waiting for an experimenter, who holds what the robot is about to do."""

from executive.events import Inbox


class Standby:
    """Opens requests that never end by themselves; the awaited decision is a separate event.

    While one is open, mission time is real time, as while a person thinks.
    """

    def __init__(self, inbox: Inbox) -> None:
        """Open requests in this inbox."""
        self._inbox = inbox

    def start(self) -> int:
        """Begin to wait; return the request's number."""
        return self._inbox.open(real=True)

    def cancel(self, request: int) -> None:
        """Stop waiting."""
        self._inbox.drop(request)
