"""A simulated world around the robot."""

from typing import Protocol


class World(Protocol):
    """A simulated world whose time the clock drives."""

    @property
    def busy(self) -> bool:
        """Whether anything moves or is due; if not, time may pass without computing it."""
        ...

    def advance(self, at_most: float) -> float:
        """Let at most so many seconds pass, less if something ends earlier; return how many."""
        ...

    def close(self) -> None:
        """Free the simulator."""
        ...


class SimulatedHome(World, Protocol):
    """A simulated world that can be drawn, and that knows the truth about its things."""

    def describe(self) -> None:
        """Record the whole scene and where everything is; called once a mission."""
        ...

    def resting_place(self, name: str) -> str | None:
        """The furniture that an object rests on, by the simulator's truth; None if on none.

        For the simulated person and for tests: the robot has no access to it.
        """
        ...

    @property
    def held(self) -> str | None:
        """The object that is in the robot's hand, by the simulator's truth; None for none."""
        ...
