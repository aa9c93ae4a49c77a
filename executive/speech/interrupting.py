"""Whether somebody speaks while the robot does, which one microphone can tell by loudness alone.

How loud the robot is to itself is learned while it speaks: nothing at all where it is heard by
headphones. What is clearly louder is somebody else. If it was a door, the robot has fallen silent
once too often; what it said can be read.
"""

LEARN_S = 2.0
"""So long it listens to itself before it believes anything."""
LOUDER = 1.3
"""Than the loudest of its own voice (tests/benchmarks/bench_own_voice.py --over): none of its own
sentences is so much louder than those before it."""
AT_LEAST_S = 0.2
FORGETS = 0.995
"""Of its own loudness, each block."""
LEAST = 150.0
"""Root mean square below which nothing is speech."""


class Interrupting:
    """Compares what is heard while the robot speaks with what it sounds like."""

    def __init__(self) -> None:
        """It has not spoken yet."""
        self._own = 0.0
        self._listened_s = self._louder_s = 0.0

    def add(self, level: float, seconds: float, *, speaking: bool) -> bool:
        """Whether somebody else has been speaking with this block, of so much loudness."""
        if not speaking:
            self._louder_s = 0.0
            return False
        if self._listened_s >= LEARN_S and level > max(LEAST, LOUDER * self._own):
            self._louder_s += seconds
            return self._louder_s >= AT_LEAST_S
        self._listened_s += seconds
        self._louder_s = 0.0
        self._own = max(FORGETS * self._own, level)
        return False
