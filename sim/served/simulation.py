"""The simulated robot behind the server, and its clock.

Simulated time passes only while the robot acts, as fast as the CPU allows up to a given speed. It
stands still while the robot plans, and while the robot is idle. So a client over the network gets
the same actions at the same simulated times as one in the same process.
"""

import queue
import time
from functools import partial

from executive.events import Inbox
from executive.ros.goals import Goal
from executive.ros.graph import Graph
from executive.ros.protocol import Message
from executive.ros.server import Server
from sim.home.home import Home
from sim.served.bodies import Body
from sim.served.messages import time_message
from sim.served.publishing import Order, Publisher
from sim.served.pursuits import Pursuits

STEP_S = 0.05
"""Longest step, and period of the clock's messages (simulated seconds)."""
STATE_S, PROGRESS_S, HEARTBEAT_S = 1 / 30, 0.2, 0.5
"""Periods (real seconds) of the robot's state, of goals' feedback, and of the state of an idle
robot."""
PICTURES_S = 0.2
"""Period of pictures while the robot acts (real seconds)."""
PLANNING_S = 0.005
"""While the robot computes, orders are checked this often (real seconds)."""


class Simulation:
    """Implements Backend. `run` is the loop of the simulation's thread; the server has its own."""

    def __init__(
        self, home: Home, body: Body, graph: Graph, inbox: Inbox, port: int, speed: float
    ) -> None:
        """Prepare everything; `run` starts the simulation.

        Args:
            home: the robot's home.
            body: the robot.
            graph: its topics and actions.
            inbox: receives the results of the robot's goals.
            port: TCP port to listen on; 0 for any that is free.
            speed: highest ratio of simulated time to real time.
        """
        self.body = body
        self.graph = graph
        self._inbox = inbox
        self._orders: queue.SimpleQueue[Order] = queue.SimpleQueue()
        self.server = Server(self, port)
        self._publisher = Publisher(
            body, self.server.publish, lambda: self._now_ns, self._orders.put
        )
        self._pursuits = Pursuits(home, body, inbox, self.server, self._publisher.tell_state)
        self._time = 0.0
        self._pace = _Pace(speed)
        self._state_due, self._progress_due = _Due(STATE_S), _Due(PROGRESS_S)
        self._pictures_due, self._heartbeat_due = _Due(PICTURES_S), _Due(HEARTBEAT_S)
        self._told_at = 0.0
        self._over = False

    # --- for the server, on its thread ---

    def time(self) -> Message:
        """The current simulated time, as a message."""
        return time_message(self._now_ns)

    def want(self, topic: str) -> None:
        """A client has subscribed to a topic."""
        self._orders.put(partial(self._publisher.want, topic))

    def leave_out(self, topic: str) -> None:
        """The last client has unsubscribed from a topic."""
        self._orders.put(partial(self._publisher.leave_out, topic))

    def start(self, goal: Goal) -> None:
        """A client has sent a goal."""
        self._orders.put(partial(self._start, goal))

    def cancel(self, goal: Goal) -> None:
        """A client has cancelled a goal."""
        self._orders.put(partial(self._cancel, goal))

    def settle(self) -> None:
        """Bring the robot to rest if it pursues no goal."""
        self._orders.put(self._pursuits.settle)

    # --- the simulation ---

    @property
    def now(self) -> float:
        """The simulated time (s)."""
        return self._time

    def stop(self) -> None:
        """End `run`; from any thread."""
        self._orders.put(self._stop)

    def run(self) -> None:
        """Run the simulation until `stop`."""
        while not self._over:
            if not self.body.busy:
                self._wait()
            elif self.body.computing:
                self._inbox.await_computed(PLANNING_S)
                self._go_on()
            else:
                self._pass_time()
                self._go_on()

    def close(self) -> None:
        """Disconnect all clients, and close the world."""
        self.server.close()
        self.body.close()

    @property
    def _now_ns(self) -> int:
        return round(self._time * 1e9)

    def _wait(self) -> None:
        """The robot is idle: sleep until there is an order, or the heartbeat is due."""
        self._pace.rest()
        self._obey(self._heartbeat_due.left)
        if self._heartbeat_due.is_now:
            self._publisher.tell_state()

    def _pass_time(self) -> None:
        passed = self.body.advance(STEP_S)
        self._publisher.forget_picture()
        self._time += passed
        self._pace.passed(passed)
        if self._time - self._told_at >= STEP_S:
            self._told_at = self._time
            self._publisher.tell_time()

    def _go_on(self) -> None:
        """Publish what is due, and carry out new orders."""
        if self._pursuits.take_ends():
            self._publisher.expect_picture()
        if self._state_due.is_now:
            self._publisher.tell_state()
        if self._progress_due.is_now:
            self._pursuits.tell_progress(self._now_ns)
        self._show_pictures()
        self._obey(self._pace.left if self.body.busy and not self.body.computing else 0.0)

    def _show_pictures(self) -> None:
        """Publish pictures if they are due, and when the robot has come to rest."""
        due = self._pictures_due.is_now and not self._publisher.is_drawing
        if self._publisher.shows_pictures and (due or not self.body.busy):
            self._publisher.tell_pictures()

    def _obey(self, seconds: float) -> None:
        """Carry out all waiting orders; wait at most `seconds` (real time) for the first."""
        try:
            order = self._orders.get(timeout=seconds) if seconds > 0 else self._orders.get_nowait()
            while True:
                order()
                order = self._orders.get_nowait()
        except queue.Empty:
            return

    def _start(self, goal: Goal) -> None:
        self._publisher.forget_picture()
        self._pursuits.start(goal, self._now_ns)

    def _cancel(self, goal: Goal) -> None:
        self._publisher.forget_picture()
        self._pursuits.cancel(goal)

    def _stop(self) -> None:
        self._over = True


class _Due:
    """A timer for something periodic (real time)."""

    def __init__(self, every_s: float) -> None:
        self._every_s = every_s
        self._next = time.monotonic()

    @property
    def left(self) -> float:
        """The time until it is due (real seconds)."""
        return max(0.0, self._next - time.monotonic())

    @property
    def is_now(self) -> bool:
        """Whether it is due; if so, the next period begins."""
        now = time.monotonic()
        if now < self._next:
            return False
        self._next = now + self._every_s
        return True


class _Pace:
    """Limits the speed of simulated time, measured from when the robot began to act."""

    def __init__(self, speed: float) -> None:
        self._speed = speed
        self.rest()

    def rest(self) -> None:
        """The robot is idle: measure from now."""
        self._began, self._passed = time.monotonic(), 0.0

    def passed(self, seconds: float) -> None:
        """Add simulated seconds that have passed."""
        self._passed += seconds

    @property
    def left(self) -> float:
        """How long to wait before more time may pass (real seconds); negative if none."""
        return self._began + self._passed / self._speed - time.monotonic()
