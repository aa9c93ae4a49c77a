"""What a mission runs on: its tree, its time and its log."""

from typing import Protocol

from executive.records import NodeState, Record, TreeShape


class Tree(Protocol):
    """The behaviour tree of one mission."""

    def shape(self) -> TreeShape:
        """All behaviours, parents before children."""
        ...

    def tick(self) -> None:
        """Let the tree decide once. It raises what a behaviour raises."""
        ...

    @property
    def status(self) -> str:
        """INVALID before the first tick, then RUNNING, SUCCESS or FAILURE."""
        ...

    @property
    def tip(self) -> str:
        """Path of the behaviour that decided the last tick."""
        ...

    def states(self) -> tuple[NodeState, ...]:
        """Every behaviour after the last tick."""
        ...

    def stop(self) -> None:
        """Interrupt whatever is running, so that it cancels what it started."""
        ...


class Clock(Protocol):
    """Mission time (seconds since the mission began)."""

    def now(self) -> float:
        """The time; it passes within `wait` only, so that a tick is replayed at its own time."""
        ...

    def restart(self) -> None:
        """Call this moment 0."""
        ...

    def wait(self, deadline: float | None) -> None:
        """Let time pass until an event is in the inbox or the deadline is reached."""
        ...


class Recorder(Protocol):
    """Keeps what happened. Never raises: a sink that fails is dropped and the mission goes on."""

    def record(self, record: Record) -> None:
        """Stamp the record with the time and pass it on; called from the ticking thread only."""
        ...
