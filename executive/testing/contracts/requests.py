"""How a contract waits for what it started: each request ends once, as an event with its number."""

import time

from executive.events import Ended, Event, Inbox
from executive.types.results import Result

PATIENCE_S = 60.0
"""So long (real time) a request may take to end."""
SILENCE_S = 0.2
"""What has not come after this does not come any more, as far as a test can tell."""


def next_event(inbox: Inbox, patience_s: float = PATIENCE_S) -> Event | None:
    """The next event, and no other; None if none comes in this time."""
    latest = time.monotonic() + patience_s
    while not inbox.has_events and (left := latest - time.monotonic()) > 0:
        inbox.wait(left)
    events = inbox.take_all()
    assert len(events) < 2, f"one event was expected, and not {events}"
    return events[0] if events else None


def end_of(inbox: Inbox, request: int) -> Result:
    """How this request ends, which is the only thing that happens meanwhile."""
    event = next_event(inbox)
    assert isinstance(event, Ended), f"request {request} did not end within {PATIENCE_S} s"
    assert event.request == request, f"request {request} was to end, and not {event.request}"
    return event.result


def is_silent(inbox: Inbox) -> bool:
    """Whether nothing comes for a moment, and nothing is awaited."""
    return next_event(inbox, SILENCE_S) is None and not inbox.awaits_anything
