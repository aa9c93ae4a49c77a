"""The simulated robot behind the server, and its time.

Time passes while the robot acts, as fast as can be up to a given speed; while it plans, and while
nothing is under way, it stands still. So whoever drives it from outside has it do the same things
at the same times as one who drives it in the same process.
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
"""The longest that passes unseen (simulated seconds); so often the clock is told."""
STATE_S, PROGRESS_S, HEARTBEAT_S = 1 / 30, 0.2, 0.5
"""How often (real seconds) the robot's state is told, how a goal gets on, and, while nothing is
under way, that all is as it was."""
PICTURES_S = 0.2
"""And pictures, to who wants to see one after the other (real seconds)."""
PLANNING_S = 0.005
"""While something is computed, orders are looked for this often (real seconds)."""


class Simulation:
    """Implements Backend. `run` is the thread of the simulation; the server has its own."""

    def __init__(
        self, home: Home, body: Body, graph: Graph, inbox: Inbox, port: int, speed: float
    ) -> None:
        """Make all ready; `run` begins.

        Args:
            home: where the robot is.
            body: it.
            graph: what it offers, and what that is called.
            inbox: where the ends of what it does go.
            port: to listen on; 0: any that is free.
            speed: how many seconds may pass in a real one.
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
        """What the clock shows."""
        return time_message(self._now_ns)

    def want(self, topic: str) -> None:
        """Somebody is new to a topic."""
        self._orders.put(partial(self._publisher.want, topic))

    def leave_out(self, topic: str) -> None:
        """Nobody wants it any more."""
        self._orders.put(partial(self._publisher.leave_out, topic))

    def start(self, goal: Goal) -> None:
        """Pursue a goal."""
        self._orders.put(partial(self._start, goal))

    def cancel(self, goal: Goal) -> None:
        """Give it up."""
        self._orders.put(partial(self._cancel, goal))

    def settle(self) -> None:
        """Come to rest, if nothing is pursued."""
        self._orders.put(self._pursuits.settle)

    # --- the simulation ---

    @property
    def now(self) -> float:
        """The robot's time (s)."""
        return self._time

    def stop(self) -> None:
        """End `run`; from any thread."""
        self._orders.put(self._stop)

    def run(self) -> None:
        """Go on until `stop`."""
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
        """Let everybody go, and free the world."""
        self.server.close()
        self.body.close()

    @property
    def _now_ns(self) -> int:
        return round(self._time * 1e9)

    def _wait(self) -> None:
        """Nothing is under way: sleep until somebody wants something."""
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
        """Tell what has come of it, and hear what is wanted meanwhile."""
        if self._pursuits.take_ends():
            self._publisher.expect_picture()
        if self._state_due.is_now:
            self._publisher.tell_state()
        if self._progress_due.is_now:
            self._pursuits.tell_progress(self._now_ns)
        self._show_pictures()
        self._obey(self._pace.left if self.body.busy and not self.body.computing else 0.0)

    def _show_pictures(self) -> None:
        """Now and then to who watches, and one of how it is at rest."""
        due = self._pictures_due.is_now and not self._publisher.is_drawing
        if self._publisher.shows_pictures and (due or not self.body.busy):
            self._publisher.tell_pictures()

    def _obey(self, seconds: float) -> None:
        """Do all that is wanted; wait for the first so long (real seconds)."""
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
    """Something that is done every so many real seconds."""

    def __init__(self, every_s: float) -> None:
        self._every_s = every_s
        self._next = time.monotonic()

    @property
    def left(self) -> float:
        """Until it is due (real seconds)."""
        return max(0.0, self._next - time.monotonic())

    @property
    def is_now(self) -> bool:
        """Whether it is due; if so, the next time begins."""
        now = time.monotonic()
        if now < self._next:
            return False
        self._next = now + self._every_s
        return True


class _Pace:
    """Holds simulated time back to a speed, from whenever the robot begins to act."""

    def __init__(self, speed: float) -> None:
        self._speed = speed
        self.rest()

    def rest(self) -> None:
        """Nothing passes now."""
        self._began, self._passed = time.monotonic(), 0.0

    def passed(self, seconds: float) -> None:
        """So many simulated seconds passed."""
        self._passed += seconds

    @property
    def left(self) -> float:
        """How long time has to wait now (real seconds)."""
        return self._began + self._passed / self._speed - time.monotonic()
