"""Helpers for contracts to wait for the ends of requests."""

import time

from executive.events import Ended, Event, Inbox
from executive.types.results import Result

PATIENCE_S = 60.0
"""How long (real seconds) a request may take to end."""
SILENCE_S = 0.2
"""How long (real seconds) a test waits to see that no event comes."""


def next_event(inbox: Inbox, patience_s: float = PATIENCE_S) -> Event | None:
    """The next event, which must be the only one; None if none comes in this time."""
    latest = time.monotonic() + patience_s
    while not inbox.has_events and (left := latest - time.monotonic()) > 0:
        inbox.wait(left)
    events = inbox.take_all()
    assert len(events) < 2, f"one event was expected, and not {events}"
    return events[0] if events else None


def end_of(inbox: Inbox, request: int) -> Result:
    """Wait for the result of this request, whose end must be the only event."""
    event = next_event(inbox)
    assert isinstance(event, Ended), f"request {request} did not end within {PATIENCE_S} s"
    assert event.request == request, f"request {request} was to end, and not {event.request}"
    return event.result


def is_silent(inbox: Inbox) -> bool:
    """Whether no event comes for a moment, and no request is open."""
    return next_event(inbox, SILENCE_S) is None and not inbox.awaits_anything
