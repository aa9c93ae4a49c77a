"""What the behaviours of a mission wait for: results that nobody has taken yet, and deadlines."""

from dataclasses import dataclass

from executive.types.results import Result


@dataclass(frozen=True, slots=True)
class Deadline:
    """Until when (mission time, s) a behaviour waits for the end of a request.

    Attributes:
        waiting: the name of that behaviour, for the log.
    """

    waiting: str
    time_s: float


class Pending:
    """The results and deadlines of one mission's requests, by request number.

    The loop puts the results in, and sleeps until the next deadline; behaviours take them out.
    """

    def __init__(self) -> None:
        """Begin with no results and no deadlines."""
        self._ends: dict[int, Result] = {}
        self._deadlines: dict[int, Deadline] = {}

    def end(self, request: int, result: Result) -> None:
        """Keep the result of a request that ended, until its behaviour takes it."""
        self._ends[request] = result

    def take_end(self, request: int) -> Result | None:
        """Take the result of a request out; None if it has not ended."""
        return self._ends.pop(request, None)

    def wait_until(self, time_s: float, request: int, waiting: str) -> None:
        """Set the deadline of a request: the tree is ticked at this mission time (s).

        `waiting` is the name of the behaviour that waits, for the log.
        """
        self._deadlines[request] = Deadline(waiting, time_s)

    def wait_no_more(self, request: int) -> None:
        """Remove the deadline of a request, if it has one."""
        self._deadlines.pop(request, None)

    @property
    def next_deadline(self) -> float | None:
        """The earliest time (mission time, s) at which a tick is due without an event."""
        return min((deadline.time_s for deadline in self._deadlines.values()), default=None)

    def deadlines(self) -> dict[str, float]:
        """The deadlines by the name of the behaviour that waits, as the log keeps them."""
        return {deadline.waiting: deadline.time_s for deadline in self._deadlines.values()}
