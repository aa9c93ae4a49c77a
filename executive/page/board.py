"""What all open pages show: notices that are replaced, and a conversation that grows.

Each change has a number. A page that comes, or comes back, says the number of the last change that
it knows and is told what is newer. So nothing is kept for a page, however slow it is or however
long it was away, and all pages show the same.
"""

import json
import secrets
import threading
import time
from collections import deque
from collections.abc import Callable
from itertools import takewhile
from typing import Any, NamedTuple

MOST_SAID = 500
"""So much of the conversation is kept for pages that are opened later."""
WAITS_S = 0.2
"""So long after pages were told something waits what need not be told at once: whenever they are
told, each browser wakes and draws."""


class Change(NamedTuple):
    """Something to show: a notice of this name, or `said`."""

    number: int
    name: str
    json: str


class Board:
    """Notices and conversation. Any thread may write, any may read."""

    def __init__(self) -> None:
        """Show nothing yet."""
        self.name = secrets.token_hex(4)
        """Tells this board from those of earlier processes, whose numbers mean nothing here."""
        self._lock = threading.Lock()
        self._last = 0
        self._told = 0
        """The last change that was there when the pages were told."""
        self._pressing = 0
        """The last change that does not wait."""
        self._tell_at = 0.0
        """When the pages were told last, or will be (s)."""
        self._notices: dict[str, Change] = {}
        self._said: deque[Change] = deque(maxlen=MOST_SAID)
        self._waiting: set[Callable[[float], None]] = set()
        self.left: Callable[[], None] = lambda: None
        """Is called when the last page that was open is closed."""
        self.over = False
        """Whether nothing comes any more."""

    def put(self, name: str, value: Any, *, waits: bool = False) -> None:
        """Show a notice in place of the one of the same name; `flush` tells the pages.

        What is the same as before is no change. What `waits` is told with the next thing that does
        not, or when `WAITS_S` is over.
        """
        text = _json(value)
        with self._lock:
            before = self._notices.get(name)
            if before is None or before.json != text:
                self._notices[name] = Change(self._next(waits=waits), name, text)

    def say(self, entry: dict[str, Any]) -> int:
        """Add to the conversation, and tell the pages; returns the number of the entry."""
        with self._lock:
            number = self._next()
            self._said.append(Change(number, "said", _json({"id": number, **entry})))
        self.flush()
        return number

    def forget(self) -> None:
        """Show nothing any more, as at the beginning; pages forget what they show, too."""
        with self._lock:
            self._said.clear()
            self._notices = {"fresh": Change(self._next(), "fresh", "{}")}

    def since(self, number: int) -> list[Change]:
        """What has changed after this number (0: everything), in the order in which it did."""

        def is_new(change: Change) -> bool:
            return change.number > number

        with self._lock:
            notices = filter(is_new, self._notices.values())
            return sorted((*notices, *takewhile(is_new, reversed(self._said))))

    def flush(self) -> None:
        """Tell those who wait, if there is something new: at once, or when it has waited."""
        now = time.monotonic()
        with self._lock:
            presses, news = self._pressing > self._told, self._last > self._told
            self._told = self._last
            if presses:
                self._tell_at = now
            elif news and self._tell_at <= now:
                self._tell_at = max(now, self._tell_at + WAITS_S)
            else:  # nothing is new, or it is told with what waits already
                return
            waiting = tuple(self._waiting)
        for wake in waiting:
            wake(self._tell_at - now)

    def end(self) -> None:
        """Nothing comes any more."""
        self.over = True
        with self._lock:
            waiting = tuple(self._waiting)
        for wake in waiting:
            wake(0.0)

    def wait_with(self, wake: Callable[[float], None]) -> None:
        """Have this called, from any thread, with in how many seconds to look for what is new."""
        with self._lock:
            self._waiting.add(wake)

    def wait_no_more(self, wake: Callable[[float], None]) -> None:
        """Do not call it any more."""
        with self._lock:
            was = bool(self._waiting)
            self._waiting.discard(wake)
            is_last = was and not self._waiting
        if is_last and not self.over:
            self.left()

    @property
    def readers(self) -> int:
        """How many pages are told of changes."""
        return len(self._waiting)

    def _next(self, *, waits: bool = False) -> int:
        self._last += 1
        if not waits:
            self._pressing = self._last
        return self._last


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=True, separators=(",", ":"))
