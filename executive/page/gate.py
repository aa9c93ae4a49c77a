"""Between what the robot says and the person: who experiments may hold sentences, and change them.

What is held, the person does not hear; a question that is held, they are not asked.
"""

import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

MOST_CHANGED = 100
"""So many changed sentences are remembered: one may be the question that is still asked."""


@dataclass(frozen=True, slots=True)
class Held:
    """A sentence that waits: its number, and what is shown of it when it is let go."""

    number: int
    entry: dict[str, Any]

    @property
    def text(self) -> str:
        """As the robot made it."""
        return str(self.entry["text"])


class Gate:
    """Lets sentences through in their order. Any thread may call it."""

    def __init__(self, show: Callable[[dict[str, Any]], object]) -> None:
        """Show what is let through by this function."""
        self._show = show
        self._lock = threading.Lock()
        self._number = 0
        self._held: list[Held] = []
        self._changed: OrderedDict[str, str] = OrderedDict()
        self.holds = False
        """Whether what is said from here on is held."""
        self.changed: Callable[[], None] = lambda: None
        """Is called when something is held, or let go."""

    @property
    def held(self) -> tuple[Held, ...]:
        """What waits, the oldest first."""
        return tuple(self._held)

    def say(self, entry: dict[str, Any]) -> None:
        """The robot says this: show it, or hold it."""
        with self._lock:
            held = self.holds or bool(self._held)
            if held:
                self._number += 1
                self._held.append(Held(self._number, entry))
            else:
                self._show_unchanged(entry)
        if held:
            self.changed()

    def find(self, number: int) -> Held | None:
        """What waits under this number."""
        return next((one for one in self.held if one.number == number), None)

    def let_go(self, number: int, words: str) -> bool:
        """Say these words in place of what waits; empty: say nothing. False if it waits no more."""
        with self._lock:
            if (one := self.find(number)) is None:
                return False
            self._held.remove(one)
            self._changed[one.text] = words
            while len(self._changed) > MOST_CHANGED:
                self._changed.popitem(last=False)
            if words:
                self._show({**one.entry, "text": words})
        self.changed()
        return True

    def let_all_go(self) -> None:
        """Hold nothing any more."""
        with self._lock:
            self.holds = False
            for one in self._held:
                self._show_unchanged(one.entry)
            self._held.clear()
        self.changed()

    def _show_unchanged(self, entry: dict[str, Any]) -> None:
        """Whatever was made of the same sentence before, it is said now; the lock is held."""
        self._changed.pop(entry["text"], None)
        self._show(entry)

    def as_said(self, text: str) -> str | None:
        """How a sentence was said, however it was made; None if the person did not hear it."""
        with self._lock:
            if any(one.text == text for one in self._held):
                return None
            return self._changed.get(text, text) or None
