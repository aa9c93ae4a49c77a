"""A served robot for tests, and a client of their own that speaks rosbridge by hand."""

import base64
import json
import math
import struct
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from itertools import count
from typing import Any, Self

import cbor2
from patience import PATIENCE_S
from websockets.sync.client import connect

from executive.testing.bench import four_rooms
from sim.served.offered import GRAPH, MOTIONS
from sim.served.serving import Plan, build
from sim.served.simulation import Simulation

ANSWERS = ("service_response", "action_result")
ZERO = {"goal_id": {"uuid": [0] * 16}, "stamp": {"sec": 0, "nanosec": 0}}
"""What means all goals."""
TYPES = {**GRAPH.actions, **MOTIONS.actions}


@contextmanager
def served(tell: Callable[[str], None] = lambda text: None, **plan: Any) -> Iterator[Simulation]:
    """A robot that is served by a thread, on a port of its own, in the instant world by default."""
    simulation = build(Plan(**{"home": four_rooms(), "world": "fake", "port": 0, **plan}), tell)
    simulation.server.listen()
    thread = threading.Thread(target=simulation.run, daemon=True)
    thread.start()
    try:
        yield simulation
    finally:
        simulation.stop()
        thread.join(PATIENCE_S)
        simulation.close()
        assert not thread.is_alive()


@contextmanager
def served_process(*options: str) -> Iterator[str]:
    """The address of a robot that is served by a process of its own."""
    command = [sys.executable, "-m", "sim", "serve", "--port", "0", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            yield next(word for word in process.stdout.readline().split() if "://" in word)
        finally:
            process.terminate()


class Raw:
    """A client: what it says and hears is plain tables."""

    def __init__(self, robot: Simulation | str, **how: Any) -> None:
        address = robot if isinstance(robot, str) else robot.server.address
        self._connecting = connect(address, max_size=2**25, **how)
        self._numbers = count()
        self.heard: list[dict[str, Any]] = []
        self._answers: list[dict[str, Any]] = []

    def __enter__(self) -> Self:
        self._socket = self._connecting.__enter__()
        return self

    def __exit__(self, *how: Any) -> None:
        self._connecting.__exit__(*how)

    def send(self, packet: str | bytes) -> None:
        """Send anything."""
        self._socket.send(packet)

    def say(self, op: str, **fields: Any) -> str:
        """Send an operation; return its id."""
        id = fields.pop("id", None) or f"{op}:{next(self._numbers)}"
        self.send(json.dumps({"op": op, "id": id, **fields}))
        return str(id)

    def hear(self, patience_s: float = PATIENCE_S) -> dict[str, Any]:
        """The next operation that comes."""
        packet = self._socket.recv(timeout=patience_s)
        said = json.loads(packet) if isinstance(packet, str) else cbor2.loads(packet)
        self.heard.append(said)
        return dict(said)

    def hear_of(self, op: str, **fields: Any) -> dict[str, Any]:
        """The next that is so; what comes before it stays in `heard`.

        Answers and ends may have come while something else was waited for: they count, too.
        """
        for said in self._answers:
            if _is(said, op, fields):
                self._answers.remove(said)
                return said
        until = time.monotonic() + PATIENCE_S
        while (left := until - time.monotonic()) > 0:
            with suppress(TimeoutError):
                if _is(said := self.hear(left), op, fields):
                    return said
                if said["op"] in ANSWERS:
                    self._answers.append(said)
        came = Counter(one["op"] for one in self.heard)
        raise AssertionError(f"no {op} with {fields} came in {PATIENCE_S} s, only {came}")

    def hears_nothing(self, for_s: float = 0.3) -> bool:
        """Whether it is quiet for so long."""
        try:
            self.hear(for_s)
        except TimeoutError:
            return True
        return False

    def call(self, service: str, /, **args: Any) -> dict[str, Any]:
        """Call a service; return its response."""
        id = self.say("call_service", service=service, args=args)
        return self.hear_of("service_response", id=id)

    def told(self, service: str, /, **args: Any) -> Any:
        """The values of a response."""
        response = self.call(service, **args)
        assert response["result"], response
        return response["values"]

    def subscribe(self, topic: str, **how: Any) -> dict[str, Any]:
        """Subscribe to a topic; return the first message."""
        self.say("subscribe", topic=topic, **how)
        return dict(self.hear_of("publish", topic=topic)["msg"])

    def pursue(self, action: str, goal: dict[str, Any], **how: Any) -> str:
        """Send a goal; return its id."""
        fields = {"action_type": TYPES[action], "feedback": True, **how}
        return self.say("send_action_goal", action=action, args=goal, **fields)

    def end_of(self, id: str) -> dict[str, Any]:
        """The result of a goal."""
        return self.hear_of("action_result", id=id)

    def do(self, action: str, goal: dict[str, Any]) -> dict[str, Any]:
        """Send a goal and wait for its end."""
        return self.end_of(self.pursue(action, goal))


def _is(said: dict[str, Any], op: str, fields: dict[str, Any]) -> bool:
    return said["op"] == op and all(said.get(name) == v for name, v in fields.items())


def pose_goal(x: float, y: float, yaw: float = 0.0, frame: str = "map") -> dict[str, Any]:
    """A goal of NavigateToPose."""
    turn = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    pose = {"position": {"x": x, "y": y, "z": 0.0}, "orientation": turn}
    return {"pose": {"header": {"frame_id": frame}, "pose": pose}, "behavior_tree": ""}


def place_goal(place: str) -> dict[str, Any]:
    """A goal of NavigateToPose that is a place of the packaged home."""
    return pose_goal(*four_rooms().stand(place))


def look_goal(place: str, view: int = 0) -> dict[str, Any]:
    """A goal of PointHead."""
    x, y, z = four_rooms().view_targets(place)[view]
    point = {"x": x, "y": y, "z": z}
    return {"target": {"header": {"frame_id": "map"}, "point": point}}


def pick_goal(label: str, points: "list[tuple[float, float, float]]") -> dict[str, Any]:
    """A goal of Pick, with the points of a thing in `map`."""
    content = b"".join(struct.pack("<fff", *point) for point in points)
    fields = [
        {"name": name, "offset": 4 * index, "datatype": 7, "count": 1}
        for index, name in enumerate("xyz")
    ]
    cloud = {
        "header": {"frame_id": "map"},
        "height": 1,
        "width": len(points),
        "fields": fields,
        "is_bigendian": False,
        "point_step": 12,
        "row_step": 12 * len(points),
        "data": base64.b64encode(content).decode(),
        "is_dense": True,
    }
    return {"label": label, "points": cloud, "confidence": 1.0, "cut_off": False}
