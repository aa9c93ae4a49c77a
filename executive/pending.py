"""What the behaviours of a mission wait for: ends that nobody has read yet, and deadlines."""

from dataclasses import dataclass

from executive.types.results import Result


@dataclass(frozen=True, slots=True)
class Deadline:
    """Until when (mission time, s) somebody waits for the end of a request."""

    waiting: str
    time_s: float


class Pending:
    """The requests of one mission, by their numbers: how they ended, until when they may.

    The loop puts in the ends, and sleeps until the next deadline; behaviours take the ends out.
    """

    def __init__(self) -> None:
        """Nothing is waited for."""
        self._ends: dict[int, Result] = {}
        self._deadlines: dict[int, Deadline] = {}

    def end(self, request: int, result: Result) -> None:
        """A request ended; keep how, until somebody reads it."""
        self._ends[request] = result

    def take_end(self, request: int) -> Result | None:
        """How a request ended, for its one reader; None if it has not."""
        return self._ends.pop(request, None)

    def wait_until(self, time_s: float, request: int, waiting: str) -> None:
        """Have the tree ticked at this mission time (s), if the request has not ended by then.

        `waiting` is the name of the behaviour that waits, for the log.
        """
        self._deadlines[request] = Deadline(waiting, time_s)

    def wait_no_more(self, request: int) -> None:
        """The deadline of a request does not count any more."""
        self._deadlines.pop(request, None)

    @property
    def next_deadline(self) -> float | None:
        """The earliest time (mission time, s) at which a tick is due without an event."""
        return min((deadline.time_s for deadline in self._deadlines.values()), default=None)

    def deadlines(self) -> dict[str, float]:
        """Who waits until when, by name, as the log keeps it."""
        return {deadline.waiting: deadline.time_s for deadline in self._deadlines.values()}
