"""The person changes their mind while the robot is on its way; the robot goes on from where it is.

    python docs/examples/changing_ones_mind.py [RUNS]   # about 20 s; then: python -m logs view RUNS

What a person says in between is an event like any other: `inbox.hear` posts it, from any thread.
Here they watch, and say it when they have seen the robot move. A sink is told twice a second, by a
thread of its own; in that time the simulated robot drives some metres.
"""

import math
import sys
from pathlib import Path

from executive import Inbox, MissionStatus, Session, load_settings
from executive.records import Record, Transforms
from logs.recorder import Stamp


class Watching:
    """A Sink that watches where the robot goes, and says something once."""

    def __init__(self, inbox: Inbox, words: str) -> None:
        """It has not moved yet."""
        self._inbox, self._words = inbox, words
        self._start: tuple[float, ...] | None = None

    def write(self, stamp: Stamp, record: Record) -> None:
        """See where it is in `map`."""
        if not isinstance(record, Transforms) or not self._words:
            return
        for one in record.transforms:
            if one.child == "base_link":
                self._start = self._start or one.pose.position
                if math.dist(self._start, one.pose.position) > 0.5:  # metres
                    self._inbox.hear(self._words)
                    self._words = ""

    def flush(self) -> None:
        """Nothing is kept."""

    def close(self) -> None:
        """Nothing is kept."""


def main(runs: str = "runs") -> None:
    """Ask for one thing, and get the other."""
    inbox = Inbox()
    settings = load_settings(runs=Path(runs), llm="none", user="none")
    person = Watching(inbox, "No, the scissors!")
    with Session(settings, inbox=inbox, sinks=[person]) as robot:
        robot.run("The scissors are on the desk")
        outcome = robot.run("Bring the hammer")
    assert (outcome.status, outcome.object) == (MissionStatus.DONE, "scissors"), outcome.reason


if __name__ == "__main__":
    main(*sys.argv[1:])
