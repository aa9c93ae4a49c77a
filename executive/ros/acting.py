"""How long a robot is at goals, by its own clock."""

from executive.ros.senses import Senses


class Acting:
    """A stopwatch that any thread may read; 0 if the robot has no clock."""

    def __init__(self, senses: Senses) -> None:
        """Stand still."""
        self._senses = senses
        self._state: tuple[float, float | None] = 0.0, None
        """What was measured before (s), and since when it runs; both change at once."""

    @property
    def seconds(self) -> float:
        """How long it ran so far."""
        before, since = self._state
        return before if since is None else before + self._senses.elapsed - since

    def run(self) -> None:
        """Go on."""
        before, since = self._state
        if since is None:
            self._state = before, self._senses.elapsed

    def pause(self) -> None:
        """Stand still."""
        self._state = self.seconds, None
