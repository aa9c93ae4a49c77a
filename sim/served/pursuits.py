"""The action goals of clients: starts, cancels and ends them, and sends feedback and results.

The robot pursues one goal at a time: a new goal of any action replaces the one before. A cancelled
goal ends when the robot is at rest.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from executive.events import Ended, Inbox
from executive.ros.goals import Goal
from executive.ros.moveit import DONE, NO_IK, NO_PLAN, NOT_FOLLOWED
from executive.ros.packets import PacketError
from executive.ros.protocol import GoalStatus, Message
from executive.ros.server import Server
from executive.types.goals import DriveTo, Halt
from executive.types.results import Failed, Result
from sim.goals import NO_MOTION, UNREACHABLE, AnyGoal, GoTo
from sim.home.home import Home
from sim.served.bodies import Body
from sim.served.messages import MAP, header, planar_pose, time_message
from sim.served.offered import ARM, DRIVE, GRIPPER, LOOK, PICK, PLACE
from sim.served.requests import Reader

FAILED = 1
"""`error_code` of a goal that was not reached."""
ERROR_CODES = {NO_MOTION: NO_PLAN, UNREACHABLE: NO_IK}
"""MoveIt's error codes, by the reasons of failed arm motions."""
THIN_M = 0.002
"""Goal tolerance of the fingers' gap (metres)."""


@dataclass(eq=False)
class _Pursuit:
    goal: Goal
    wanted: AnyGoal
    began_ns: int


@dataclass(eq=False)
class _Halting:
    """A request to come to rest, and the cancelled goals that end with it."""

    request: int
    goals: list[Goal] = field(default_factory=list)


class Pursuits:
    """The open goals of clients. Use it only on the simulation's thread."""

    def __init__(
        self, home: Home, body: Body, inbox: Inbox, server: Server, tell_state: Callable[[], None]
    ) -> None:
        """Begin without goals.

        Args:
            home: the robot's home.
            body: the robot.
            inbox: receives the results of its goals.
            server: sends feedback and results to clients.
            tell_state: publishes the robot's state; called before each result is sent.
        """
        self._home = home
        self._body = body
        self._inbox = inbox
        self._server = server
        self._tell_state = tell_state
        reader = Reader(home, body.look)
        self._readers: dict[str, Callable[[Message], AnyGoal]] = {
            DRIVE: reader.drive,
            LOOK: reader.point_head,
            PICK: reader.pick,
            PLACE: reader.place,
            ARM: reader.move,
            GRIPPER: reader.grip,
        }
        self._open: dict[int, _Pursuit] = {}
        self._halting: _Halting | None = None

    def start(self, goal: Goal, time_ns: int) -> None:
        """Pursue a goal, or refuse it if it is invalid."""
        try:
            wanted = self._readers[goal.action](goal.args)
        except PacketError as error:
            self._server.refuse(goal, str(error))
            return
        self._server.accept(goal, time_ns)
        request = self._body.start(wanted)
        self._open[request] = _Pursuit(goal, wanted, time_ns)
        self.take_ends()
        self.tell_progress(time_ns)

    def cancel(self, goal: Goal) -> None:
        """Cancel a goal, and bring the robot to rest."""
        for request, pursuit in tuple(self._open.items()):
            if pursuit.goal is goal:
                self._body.cancel(request)
                del self._open[request]
                if self._halting is None:
                    self._halting = _Halting(self._body.start(Halt()))
                self._halting.goals.append(goal)

    def settle(self) -> None:
        """Bring the robot to rest if it is idle: a look may end before the head is still."""
        if not self._body.busy and self._body.moves:
            self._halting = _Halting(self._body.start(Halt()))

    def take_ends(self) -> bool:
        """Send the results of goals that have ended; return whether one of them was a look."""
        looked = False
        for event in self._inbox.take_all():
            if isinstance(event, Ended):
                pursuit = self._open.get(event.request)
                looked |= pursuit is not None and pursuit.goal.action == LOOK
                self._end(event.request, event.result)
        return looked

    def tell_progress(self, time_ns: int) -> None:
        """Send feedback for all open goals."""
        for pursuit in self._open.values():
            self._server.feedback(pursuit.goal, self._feedback(pursuit, time_ns))

    def _end(self, request: int, result: Result) -> None:
        pursuit = self._open.pop(request, None)
        if pursuit is not None:
            self._tell_state()
            failed = isinstance(result, Failed)
            status = GoalStatus.ABORTED if failed else GoalStatus.SUCCEEDED
            self._server.end(pursuit.goal, status, self._values(pursuit.goal, result))
        elif self._halting is not None and self._halting.request == request:
            self._tell_state()
            goals, self._halting = self._halting.goals, None
            for goal in goals:
                values = self._values(goal, Failed("cancelled"))
                self._server.end(goal, GoalStatus.CANCELED, values)

    def _feedback(self, pursuit: _Pursuit, time_ns: int) -> Message:
        passed = time_message(time_ns - pursuit.began_ns)
        match pursuit.wanted:
            case DriveTo(place):
                goal = self._home.stand(place)
            case GoTo(x, y, yaw):
                goal = (x, y, yaw)
            case _:
                return {"elapsed": passed} if pursuit.goal.action in (PICK, PLACE) else {}
        here = self._body.pose
        return {
            "current_pose": {"header": header(time_ns, MAP), "pose": planar_pose(here)},
            "navigation_time": passed,
            "number_of_recoveries": 0,
            "distance_remaining": math.dist(here[:2], goal[:2]),
        }

    def _values(self, goal: Goal, result: Result) -> Message:
        """The result message of a goal's action."""
        failed = result if isinstance(result, Failed) else None
        if goal.action == GRIPPER:
            return self._grip(goal)
        if goal.action == ARM:
            code = ERROR_CODES.get(failed.reason, NOT_FOLLOWED) if failed else DONE
            return {"error_code": {"val": code}}
        reason = failed.reason if failed else ""
        error = {"error_code": FAILED if failed else 0, "error_msg": reason}
        if goal.action in (PICK, PLACE):
            return {**error, "lost": failed is not None and failed.lost}
        return error

    def _grip(self, goal: Goal) -> Message:
        """The result of `GripperCommand`: the gripper has stalled if it is not at its goal."""
        gap, wanted = self._body.gap, goal.args["command"]
        reached = abs(gap - wanted["position"]) < THIN_M
        return {
            "position": gap,
            "effort": wanted.get("max_effort", 0.0),
            "stalled": not reached,
            "reached_goal": reached,
        }
