"""When a served robot comes to rest, in time that the machine gave to this process."""

import threading
import time
from typing import Self

from odd_wire import OddWire

from sim.served.simulation import Simulation

LOOK_S = 0.005


class Watch:
    """Looks at a robot and at the wire before it, again and again; `with` ends it.

    Its seconds are real ones, less those in which this process had something to do and was not
    let: so a busy machine makes no robot late. What it computes itself counts in full.
    """

    def __init__(self, robot: Simulation, wire: OddWire) -> None:
        self._robot = robot
        self._wire = wire
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self.now = 0.0
        self.moved = 0.0
        """When it moved last."""
        self.whole_since = float("-inf")
        """Since when there is a link, both sockets of it; infinite while there is none."""

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._thread.join()

    def wait_for_rest(self, at_most_s: float) -> bool:
        """Whether it rests, after so long at the latest."""
        latest = self.now + at_most_s
        while self._robot.body.busy and self.now < latest:
            time.sleep(LOOK_S)
        return not self._robot.body.busy

    def _run(self) -> None:
        looked, computed = time.monotonic(), time.process_time()
        while not self._over.wait(LOOK_S):
            before, computed_before = looked, computed
            looked, computed = time.monotonic(), time.process_time()
            self.now += min(looked - before, 2 * LOOK_S + computed - computed_before)
            if self._robot.body.busy:
                self.moved = self.now
            if not self._wire.is_whole:
                self.whole_since = float("inf")
            elif self.whole_since == float("inf"):
                self.whole_since = self.now
