"""A robot of the tests' own behind rosbridge: other names, other encodings, and no head.

It glides in straight lines, in real time; what it may grab lies within its reach.
"""

import asyncio
import json
import math
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from beside import Beside
from patience import PATIENCE_S
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from executive.ros.packets import PacketError
from executive.ros.protocol import (
    ActionFeedback,
    ActionResult,
    CallService,
    CancelActionGoal,
    Compression,
    GoalStatus,
    Operation,
    Publish,
    SendActionGoal,
    ServiceResponse,
    Subscribe,
    Unsubscribe,
    decode,
    encode,
)

PROFILE = Path(__file__).with_name("second_robot.toml")
PERIOD_S = 0.02
SPEED_M_S = 3.0
TOPICS = {
    "/tf": "tf2_msgs/msg/TFMessage",
    "/acme/odom": "nav_msgs/msg/Odometry",
    "/acme/rgb": "sensor_msgs/msg/Image",
    "/acme/range": "sensor_msgs/msg/Image",
    "/acme/lens": "sensor_msgs/msg/CameraInfo",
    "/acme/fingers": "sensor_msgs/msg/JointState",
}
ACTIONS = {
    "/acme/go": "acme_msgs/action/Go",
    "/acme/grab": "acme_msgs/action/Grab",
    "/acme/drop": "acme_msgs/action/Drop",
    "/acme/way": "nav2_msgs/action/ComputePathToPose",
}
GOALS = {
    "Go": {"where": "geometry_msgs/PoseStamped", "hurry": "boolean"},
    "Grab": {"what": "string", "cloud": "sensor_msgs/PointCloud2"},
    "Drop": {"near": "geometry_msgs/PointStamped"},
}
"""The types of their goals' fields."""
HEADED = {
    "geometry_msgs/PoseStamped": {"header": "std_msgs/Header", "pose": "geometry_msgs/Pose"},
    "std_msgs/Header": {"stamp": "builtin_interfaces/Time", "frame_id": "string"},
}
FIXED_ARRAYS = ("/acme/odom", "/acme/lens")
"""What a rosbridge of before March 2026 cannot send as CBOR."""
GOAL_DETAILS = "/rosapi/action_goal_details"
EYE_M = 1.0
WIDTH, HEIGHT, FOCAL = 64, 48, 60.0


class SecondRobot(Beside):
    """The robot and its server, on a thread of its own; `with` ends it."""

    topics, actions = TOPICS, ACTIONS
    frames = "/tf"
    """The topic on which it tells where its frames are."""

    def __init__(self, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
        self.at = at
        self.speed = 0.0
        self.holds = ""
        self.graspable = ""
        self.deaf: set[str] = set()
        """Actions that never answer a goal."""
        self.endless: set[str] = set()
        """Actions that give feedback of a goal, and never come to its end."""
        self.stubborn: set[str] = set()
        """Actions that do not cancel."""
        self.goals: list[tuple[str, dict[str, Any]]] = []
        self.cancels = 0
        self.undiscovered = 0
        """So many cancels find no action: as by a bridge that has just begun."""
        self.unheard = 0
        """So many cancels are lost on their way."""
        self.told: dict[str, dict[str, Any]] = {}
        """Fields of a topic's messages that are told otherwise."""
        self.shut: int | None = None
        """Nobody is let in: what is answered, in HTTP's numbers."""
        self.sends_to = ""
        """Who comes is sent on to this address."""
        self.headers: list[dict[str, str]] = []
        self._clients: dict[ServerConnection, dict[str, Subscribe]] = {}
        self._under_way: dict[str, tuple[ServerConnection, SendActionGoal]] = {}
        self.time_s = 1000.0
        """The robot's own time, which a busy machine slows as it slows all else."""

    @property
    def busy(self) -> bool:
        return bool(self._under_way)

    def is_wanted(self, topic: str) -> bool:
        """Whether anybody has subscribed to it."""
        wishes = [tuple(one.values()) for one in tuple(self._clients.values())]
        return any(wish.topic == topic for one in wishes for wish in one)

    def cut(self, *, only_stop: bool = False) -> None:
        """Break off all connections, or that for stopping, where nothing is subscribed to."""
        clients = self._clients.items()
        for client in [one for one, topics in clients if not (only_stop and topics)]:
            self._loop.call_soon_threadsafe(client.transport.abort)

    def advance(self, at_most: float) -> float:
        """Let a little of its time pass; how much did (s)."""
        began = self.time_s
        time.sleep(min(at_most, 0.02))
        return self.time_s - began

    def say(self, packet: str | bytes) -> None:
        """Send this to whoever listens, as it is."""
        for client in tuple(self._clients):
            asyncio.run_coroutine_threadsafe(client.send(packet), self._loop).result(PATIENCE_S)

    def call_off(self, action: str, **said: Any) -> None:
        """Cancel its goal, as somebody else may."""
        end = self._end(action, GoalStatus.CANCELED, **said)
        asyncio.run_coroutine_threadsafe(end, self._loop).result(PATIENCE_S)

    # --- the server ---

    async def serve(self) -> None:
        how: dict[str, Any] = {"compression": None, "process_request": self._let_in}
        async with serve(self._talk, "127.0.0.1", 0, **how) as server:
            life = asyncio.create_task(self._live())
            await self.listens(next(iter(server.sockets)).getsockname()[1])
            life.cancel()

    def _let_in(self, client: ServerConnection, _: Request) -> Response | None:
        if self.sends_to:
            away = client.respond(307, "over there")
            away.headers["Location"] = self.sends_to
            return away
        return client.respond(self.shut, "not now") if self.shut else None

    async def _talk(self, client: ServerConnection) -> None:
        self._clients[client] = {}
        assert client.request is not None
        self.headers.append(dict(client.request.headers.raw_items()))
        with suppress(ConnectionClosed):
            async for packet in client:
                with suppress(PacketError):  # rosbridge says so, and goes on
                    await self._take(client, decode(packet))
        del self._clients[client]

    async def _take(self, client: ServerConnection, operation: Operation) -> None:
        if self.unheard and _cancels(operation):
            self.unheard -= 1
            return
        match operation:
            case Subscribe(id=id):
                self._clients[client][id] = operation
            case Unsubscribe(id=id):
                self._clients[client].pop(id, None)
            case CallService():
                assert isinstance(operation.args, dict)
                values = self._answer(operation.service, operation.args)
                answer = ServiceResponse(operation.service, bool(values), values, operation.id)
                await client.send(encode(answer))
            case SendActionGoal(action=action):
                assert isinstance(operation.args, dict)
                self.goals.append((action, json.loads(json.dumps(operation.args))))
                if action not in self.deaf:
                    self._under_way[action] = client, operation
            case CancelActionGoal(action=action):
                await self._end(action, GoalStatus.CANCELED)

    def _answer(self, service: str, args: dict[str, Any]) -> dict[str, Any]:
        if service.endswith("/_action/cancel_goal"):
            action = service.removesuffix("/_action/cancel_goal")
            self.cancels += 1
            if self.undiscovered:
                self.undiscovered -= 1
                return {}
            if action in self.stubborn:
                return {"return_code": 1, "goals_canceling": []}
            asyncio.ensure_future(self._end(action, GoalStatus.CANCELED))
            return {"return_code": 0, "goals_canceling": []}
        if service == GOAL_DETAILS:
            name = args["type"].rpartition("/")[2]
            kinds = {f"acme_msgs/{name}_Goal": GOALS[name], **HEADED} if name in GOALS else {}
            return {"typedefs": [_typedef(kind, fields) for kind, fields in kinds.items()]}
        feedbacks = {
            f"{n}/_action/feedback": f"{k}_FeedbackMessage" for n, k in self.actions.items()
        }
        told = {**self.topics, **feedbacks}
        return {
            "/rosapi/topics": {"topics": list(told), "types": list(told.values())},
            "/rosapi/services": {"services": ["/rosapi/topics", GOAL_DETAILS]},
            "/rosapi/action_servers": {"action_servers": list(self.actions)},
        }.get(service, {})

    async def _end(self, action: str, status: GoalStatus, said: str = "", **more: Any) -> None:
        client, goal = self._under_way.pop(action, (None, None))
        if action == "/acme/go" and status == GoalStatus.CANCELED:
            self.speed = 0.0
        if client is not None and goal is not None:
            values = {"message": said, **more}
            done = status == GoalStatus.SUCCEEDED
            with suppress(ConnectionClosed):
                await client.send(encode(ActionResult(action, done, status, values, goal.id)))

    # --- the robot ---

    async def _live(self) -> None:
        while True:
            await asyncio.sleep(PERIOD_S)
            self.time_s += PERIOD_S
            for action in tuple(self._under_way):
                await self._pursue(action)
            await self._tell()

    async def _pursue(self, action: str) -> None:
        client, goal = self._under_way[action]
        assert isinstance(goal.args, dict)
        with suppress(ConnectionClosed):
            await client.send(encode(ActionFeedback(action, {"fine": True}, goal.id)))
        match action:
            case _ if action in self.endless:
                self.speed = SPEED_M_S
            case "/acme/way":
                await self._end(action, GoalStatus.SUCCEEDED, **self._way(goal.args["goal"]))
            case "/acme/go":
                await self._go(goal.args["where"]["pose"])
            case "/acme/grab":
                if goal.args["what"] != self.graspable:
                    await self._end(action, GoalStatus.ABORTED, "there is nothing to grab")
                else:
                    self.holds, self.graspable = self.graspable, ""
                    await self._end(action, GoalStatus.SUCCEEDED)
            case _:
                held, self.holds = self.holds, ""
                said = "" if held else "my hand is empty"
                await self._end(action, GoalStatus.SUCCEEDED if held else GoalStatus.ABORTED, said)

    def _way(self, goal: dict[str, Any]) -> dict[str, Any]:
        """A straight line, a pose each 5 cm."""
        end = goal["pose"]["position"]
        number = max(2, int(math.dist(self.at[:2], (end["x"], end["y"])) / 0.05))
        ways = np.linspace(self.at[:2], (end["x"], end["y"]), number)
        turn = goal["pose"]["orientation"]
        poses = [{"position": {"x": x, "y": y, "z": 0.0}, "orientation": turn} for x, y in ways]
        return {"path": {"poses": [{"pose": pose} for pose in poses]}}

    async def _go(self, pose: dict[str, Any]) -> None:
        x, y, _ = self.at
        ahead = math.dist((x, y), (pose["position"]["x"], pose["position"]["y"]))
        step = SPEED_M_S * PERIOD_S
        turn = 2 * math.atan2(pose["orientation"]["z"], pose["orientation"]["w"])
        if ahead <= step:
            self.at, self.speed = (pose["position"]["x"], pose["position"]["y"], turn), 0.0
            await self._end("/acme/go", GoalStatus.SUCCEEDED)
            return
        part, self.speed = step / ahead, SPEED_M_S
        self.at = (
            x + part * (pose["position"]["x"] - x),
            y + part * (pose["position"]["y"] - y),
            self.at[2],
        )

    async def _tell(self) -> None:
        made: dict[str, dict[str, Any]] = {}
        makers: dict[str, Callable[[], dict[str, Any]]] = {
            self.frames: self._frames,
            "/acme/odom": self._odometry,
            "/acme/rgb": self._color,
            "/acme/range": self._range,
            "/acme/lens": self._lens,
            "/acme/fingers": self._fingers,
        }
        for client, subscriptions in tuple(self._clients.items()):
            wanted = {one.topic: one.compression for one in subscriptions.values()}
            for topic in (name for name in makers if name in wanted):
                if topic in FIXED_ARRAYS and wanted[topic] == Compression.CBOR:
                    continue
                message = made.setdefault(topic, makers[topic]() | self.told.get(topic, {}))
                with suppress(ConnectionClosed):
                    await client.send(encode(Publish(topic, message), wanted[topic]))

    def _header(self, frame: str) -> dict[str, Any]:
        whole = int(self.time_s)
        stamp = {"sec": whole, "nanosec": int((self.time_s - whole) * 1e9)}
        return {"frame_id": frame, "stamp": stamp}

    def _frames(self) -> dict[str, Any]:
        x, y, yaw = self.at
        upright = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
        ahead = {"x": -0.5, "y": 0.5, "z": -0.5, "w": 0.5}
        body = {"translation": {"x": x, "y": y, "z": 0.0}, "rotation": upright}
        eye = {"translation": {"x": 0.1, "y": 0.0, "z": EYE_M}, "rotation": ahead}
        return {
            "transforms": [
                {"header": self._header("world"), "child_frame_id": "body", "transform": body},
                {"header": self._header("body"), "child_frame_id": "eye", "transform": eye},
            ]
        }

    def _odometry(self) -> dict[str, Any]:
        none = {"x": 0.0, "y": 0.0, "z": 0.0}
        twist = {"linear": {**none, "x": self.speed}, "angular": none}
        return {"header": self._header("world"), "twist": {"twist": twist}}

    def _color(self) -> dict[str, Any]:
        pixels = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        pixels[..., 0] = 200  # blue: first, as in bgr8
        return self._image("bgr8", pixels.tobytes(), 3)

    def _range(self) -> dict[str, Any]:
        """Millimetres: the floor below the middle, nothing above."""
        rows = np.arange(HEIGHT) - HEIGHT // 2
        depth = np.zeros((HEIGHT, WIDTH), "<u2")
        depth[rows > 3] = (1000 * EYE_M * FOCAL / rows[rows > 3])[:, None]
        padded = np.pad(depth, ((0, 0), (0, 4)))
        return {**self._image("16UC1", padded.tobytes(), 2), "step": 2 * (WIDTH + 4)}

    def _image(self, encoding: str, data: bytes, bytes_of_pixel: int) -> dict[str, Any]:
        return {
            "header": self._header("eye"),
            "height": HEIGHT,
            "width": WIDTH,
            "encoding": encoding,
            "is_bigendian": 0,
            "step": bytes_of_pixel * WIDTH,
            "data": data,
        }

    def _lens(self) -> dict[str, Any]:
        k = np.array([FOCAL, 0, WIDTH / 2, 0, FOCAL, HEIGHT / 2, 0, 0, 1])
        return {"header": self._header("eye"), "width": WIDTH, "height": HEIGHT, "k": k}

    def _fingers(self) -> dict[str, Any]:
        width = 0.02 if self.holds else 0.0
        return {
            "header": self._header(""),
            "name": ["finger"],
            "position": np.array([width]),
            "velocity": np.array([0.0]),
        }


def _typedef(kind: str, fields: dict[str, str]) -> dict[str, Any]:
    return {"type": kind, "fieldnames": list(fields), "fieldtypes": list(fields.values())}


def _cancels(operation: Operation) -> bool:
    return isinstance(operation, CancelActionGoal) or (
        isinstance(operation, CallService) and operation.service.endswith("/_action/cancel_goal")
    )
