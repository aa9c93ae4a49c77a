"""Who stepped in, while a mission ran or between two: what the study's journal keeps of it."""

import threading
import time
from dataclasses import dataclass
from datetime import UTC, datetime

from executive.events import Intervened, StopRequested
from executive.page.experiment.wizard import AS_BEFORE
from executive.page.study.tables import STOP
from executive.records import EventTaken, Record
from logs.recorder import Stamp


@dataclass(frozen=True)
class SteppedIn:
    """What somebody did, who, and when; what was, and what became of it.

    Attributes:
        at: wall time (ISO 8601, UTC).
        time_s: mission time; 0 if no mission heard of it, because none ran.
    """

    what: str
    by: str
    at: str
    time_s: float = 0.0
    was: str = ""
    became: str = ""


class Watch:
    """Implements Sink."""

    def __init__(self) -> None:
        """Nobody has stepped in."""
        self._lock = threading.Lock()
        self._seen: list[SteppedIn] = []
        self._unheard: list[tuple[int, Intervened]] = []
        """With when it was done (wall time, ns since 1970)."""

    def write(self, stamp: Stamp, record: Record) -> None:
        """Keep it if somebody stepped in."""
        match record:
            case EventTaken(StopRequested() as stop) if not stop.is_of_experimenter:
                with self._lock:
                    seen = SteppedIn(STOP, stop.by, _iso(stamp.wall_ns), stamp.mission_s)
                    self._seen.append(seen)
            case EventTaken(Intervened() as event):
                self._hear(event, stamp)
            case _:
                pass

    def beside(self, event: Intervened) -> None:
        """An experimenter does this; a mission that runs hears of it. From any thread."""
        with self._lock:
            self._unheard.append((time.time_ns(), event))

    def _hear(self, event: Intervened, stamp: Stamp) -> None:
        with self._lock:
            self._unheard = [one for one in self._unheard if one[1] is not event]
            if event.was != AS_BEFORE:
                self._seen.append(_stepped_in(event, stamp))

    def flush(self) -> None:
        """Nothing to bring to disk."""

    def close(self) -> None:
        """The mission is over; the next one goes on here."""

    def take_all(self) -> list[SteppedIn]:
        """What the last mission heard of."""
        with self._lock:
            seen, self._seen = self._seen, []
        return seen

    def take_unheard(self) -> list[SteppedIn]:
        """What no mission heard of; for when none runs."""
        with self._lock:
            unheard, self._unheard = self._unheard, []
        return [_stepped_in(event, Stamp(0.0, wall_ns)) for wall_ns, event in unheard]


def _stepped_in(event: Intervened, stamp: Stamp) -> SteppedIn:
    at = _iso(stamp.wall_ns)
    return SteppedIn(event.deed, event.by, at, stamp.mission_s, event.was, event.became)


def _iso(wall_ns: int) -> str:
    return datetime.fromtimestamp(wall_ns / 1e9, UTC).isoformat(timespec="milliseconds")
