"""The simulated world."""

from typing import Protocol


class World(Protocol):
    """A simulated world that the clock advances."""

    @property
    def busy(self) -> bool:
        """Whether anything moves or is scheduled; if not, the clock need not simulate the time."""
        ...

    def advance(self, at_most: float) -> float:
        """Simulate up to `at_most` seconds; return how many (fewer if a request ends earlier)."""
        ...

    def close(self) -> None:
        """Free the simulator."""
        ...


class SimulatedHome(World, Protocol):
    """A simulated world that can be recorded, and that has the ground truth about its things."""

    def describe(self) -> None:
        """Record the whole scene and the poses of everything; called once per mission."""
        ...

    def resting_place(self, name: str) -> str | None:
        """Ground truth: the furniture that an object rests on; None if on none.

        Only for the simulated person and for tests; the robot must not use it.
        """
        ...

    @property
    def held(self) -> str | None:
        """Ground truth: the object in the robot's hand; None if it is empty."""
        ...
