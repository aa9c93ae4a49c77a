"""Who stepped in while a mission ran: a log that keeps it for the study's journal."""

import threading
from dataclasses import dataclass

from executive.events import Intervened, StopRequested
from executive.page.study.tables import STOP
from executive.records import EventTaken, Record
from logs.recorder import Stamp


@dataclass(frozen=True)
class SteppedIn:
    """What somebody did, who, and when (mission time, s); what was, and what became of it."""

    what: str
    by: str
    time_s: float
    was: str = ""
    became: str = ""


class Watch:
    """Implements Sink."""

    def __init__(self) -> None:
        """Nobody has stepped in."""
        self._lock = threading.Lock()
        self._seen: list[SteppedIn] = []

    def write(self, stamp: Stamp, record: Record) -> None:
        """Keep it if somebody stepped in."""
        match record:
            case EventTaken(StopRequested(by)):
                with self._lock:
                    self._seen.append(SteppedIn(STOP, by, stamp.mission_s))
            case EventTaken(Intervened(by, deed, was, became)):
                with self._lock:
                    self._seen.append(SteppedIn(deed, by, stamp.mission_s, was, became))
            case _:
                pass

    def flush(self) -> None:
        """Nothing to bring to disk."""

    def close(self) -> None:
        """The mission is over; the next one goes on here."""

    def take_all(self) -> list[SteppedIn]:
        """What was seen since the last time."""
        with self._lock:
            seen, self._seen = self._seen, []
        return seen
