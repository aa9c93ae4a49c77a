"""Detects by loudness, with one microphone, that somebody speaks while the robot does.

It learns the loudness of the robot's own voice while it speaks: 0 with headphones. What is clearly
louder is somebody else. If it was a door, the robot was silenced needlessly; its words can still be
read.
"""

LEARN_S = 2.0
"""How long (s) it measures the robot's voice before it detects anything."""
LOUDER = 1.3
"""Somebody else is louder than the loudest of the robot's voice by this factor. No sentence of the
robot was so much louder than those before it (tests/benchmarks/bench_own_voice.py --over)."""
AT_LEAST_S = 0.2
"""How long (s) somebody else has to be louder."""
FORGETS = 0.995
"""The measured loudness of the robot's voice decays by this factor with each block."""
LEAST = 150.0
"""Level (root mean square) below which nothing is speech."""


class Interrupting:
    """Compares the level while the robot speaks with that of its own voice."""

    def __init__(self) -> None:
        """Begin without a measurement."""
        self._own = 0.0
        self._listened_s = self._louder_s = 0.0

    def add(self, level: float, seconds: float, *, speaking: bool) -> bool:
        """Add a block; return whether somebody else speaks into the robot's words.

        Args:
            level: the level of the block (root mean square).
            seconds: its duration.
            speaking: whether the robot spoke meanwhile; if not, the result is False.
        """
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
