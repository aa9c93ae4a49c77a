"""The runtime of a mission: tree, clock and recorder."""

from typing import Protocol

from executive.records import NodeState, Record, TreeShape


class Tree(Protocol):
    """The behaviour tree of one mission."""

    def shape(self) -> TreeShape:
        """The structure of the tree: all behaviours, parents before children."""
        ...

    def tick(self) -> None:
        """Tick the tree once. Exceptions of behaviours are passed on."""
        ...

    @property
    def status(self) -> str:
        """INVALID before the first tick, then RUNNING, SUCCESS or FAILURE."""
        ...

    @property
    def tip(self) -> str:
        """Path of the behaviour that decided the result of the last tick."""
        ...

    def states(self) -> tuple[NodeState, ...]:
        """The state of every behaviour after the last tick."""
        ...

    def stop(self) -> None:
        """Interrupt all running behaviours, so that they cancel their requests."""
        ...


class Clock(Protocol):
    """Mission time (seconds since the mission began)."""

    def now(self) -> float:
        """The time; it advances only inside `wait`, so that a replayed tick has the same time."""
        ...

    def restart(self) -> None:
        """Set mission time to 0 now."""
        ...

    def wait(self, deadline: float | None) -> None:
        """Block until an event is in the inbox or the deadline (mission time, s) is reached.

        With None, there is no deadline.
        """
        ...


class Recorder(Protocol):
    """Writes the log. Never raises: a sink that fails is dropped and the mission goes on."""

    def record(self, record: Record) -> None:
        """Add the timestamp and write the record; called only from the ticking thread."""
        ...
