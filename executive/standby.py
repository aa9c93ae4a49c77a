"""Waiting for somebody who was not asked: who experiments, and holds what the robot would do."""

from executive.events import Inbox


class Standby:
    """Numbers requests that nothing ends; what is awaited comes as an event of its own.

    As long as one is open, mission time is real time, as while a person thinks.
    """

    def __init__(self, inbox: Inbox) -> None:
        """Wait in this inbox."""
        self._inbox = inbox

    def start(self) -> int:
        """Begin to wait; the number of the request."""
        return self._inbox.open(real=True)

    def cancel(self, request: int) -> None:
        """Wait no more."""
        self._inbox.drop(request)
