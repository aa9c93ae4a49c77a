"""The link by rclpy, for who has ROS 2 on this machine: `--robot ros2:`.

rclpy spins on a thread of its own; what comes of it is handed to the thread of the wire.
"""

import asyncio
import logging
import threading
import time
from collections.abc import Awaitable, Callable
from contextlib import suppress
from typing import Any
from uuid import uuid4

import numpy as np

from executive.guards import in_words
from executive.ros.link import GoalEnd, LinkError, Receive
from executive.ros.offers import Offers
from executive.ros.protocol import GoalStatus, Message
from executive.ros.rclpy_messages import fill, to_table, type_named

NODE = "robot_executive"
SERVER_S = 3.0
"""So long an action's server may take to be found."""
MATCHING_S = 0.5
"""A server that is found has mostly found who asks it by then. Asked before, it cannot answer, and
one that is made with rclpy may go down by that."""
MEETING_S = 4.0
"""So long it may take at most."""
AGAIN_S = 0.2
DISCOVERY_S, QUIET_S = 15.0, 3.5
"""So long a graph may take to be discovered; one to which nothing is added for so long is whole: a
heartbeat, every 3 s by Fast DDS's defaults, tells again what a lost packet hid."""
LOOK_S = 0.02
DEPTH = 10
_GOAL, _KIND = "/_action/send_goal", "_SendGoal"
"""The hidden service that each action's server has."""

Server = frozenset[bytes]
"""Who serves an action: what its publishers of the goals' status are called in the graph."""

log = logging.getLogger(__name__)


class RclpyLink:
    """Implements `Link`; made on the thread of the wire."""

    def __init__(self) -> None:
        """Join the graph.

        Raises:
            LinkError: if there is no ROS 2 here.
        """
        try:
            import rclpy
            from rclpy.executors import SingleThreadedExecutor
        except ImportError as error:
            why = "source its setup.bash, with this version of Python; or use rosbridge"
            raise LinkError(f"rclpy cannot be imported ({error}): {why}") from None
        self.loss, self.losses = "", 0
        self._loop = asyncio.get_running_loop()
        self._context = rclpy.Context()
        rclpy.init(context=self._context)
        self._node = rclpy.create_node(NODE, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._spinning = threading.Thread(target=self._spin, name="rclpy", daemon=True)
        self._spinning.start()
        self._greeter: asyncio.Task[None] | None = None
        self._actions: dict[str, Any] = {}
        self._met: set[tuple[str, Server]] = set()
        """Actions whose server has found who asks it; one that comes back has to find it anew."""
        self._clients: dict[str, Any] = {}
        self._publishers: dict[str, Any] = {}

    def _spin(self) -> None:
        """Until the context is shut down; who leaves in the wrong moment ends what rclpy is at."""
        while self._context.ok():
            try:
                self._executor.spin()
            except Exception as error:
                if self._context.ok():
                    log.info("rclpy broke off, and goes on: %s", in_words(error))
                    time.sleep(LOOK_S)

    async def ready(self, within_s: float) -> None:
        """Wait until the robot is greeted."""
        if self._greeter is not None:
            await asyncio.wait({self._greeter}, timeout=within_s)

    def greet_with(self, greeting: Callable[[], Awaitable[None]]) -> None:
        """Do this now: there is no losing and finding again that could be noticed."""
        self._greeter = asyncio.create_task(_greet(greeting))

    async def offers(self) -> Offers:
        """By the graph that the node sees, as soon as nothing is added any more."""
        seen, latest = self._graph(), self._loop.time() + DISCOVERY_S
        while self._loop.time() < latest:
            await asyncio.sleep(QUIET_S)
            before, seen = seen, self._graph()
            if seen == before and seen.actions:
                break
        return seen

    def _graph(self) -> Offers:
        topics = {name: kinds[0] for name, kinds in self._node.get_topic_names_and_types()}
        services = {name: kinds[0] for name, kinds in self._node.get_service_names_and_types()}
        actions = {  # those that somebody serves, and not only asks for
            name.removesuffix(_GOAL): kind.removesuffix(_KIND)
            for name, kind in services.items()
            if name.endswith(_GOAL)
        }
        return Offers(topics, tuple(services), actions)

    async def call(
        self, service: str, kind: str, request: Message, *, within_s: float, urgent: bool = False
    ) -> Message:
        """Call a service; here nothing waits for anything else."""
        made = type_named(kind)
        if service not in self._clients:
            self._clients[service] = self._node.create_client(made, service)
        client = self._clients[service]
        try:
            async with asyncio.timeout(within_s):
                while not client.service_is_ready():
                    await asyncio.sleep(LOOK_S)
                asked = client.call_async(fill(made.Request(), request))
                return to_table(await self._awaited(asked))
        except TimeoutError:
            raise LinkError(f"{service} does not answer") from None

    async def pursue(self, action: str, kind: str, goal: Message, feedback: Receive) -> GoalEnd:
        """Have an action pursue a goal, to its end."""
        client, made = await self._server(action, kind)

        def hear(message: Any) -> None:
            self._loop.call_soon_threadsafe(feedback, to_table(message.feedback))

        sent = client.send_goal_async(fill(made.Goal(), goal), feedback_callback=hear)
        try:
            handle = await self._awaited(sent)
        except asyncio.CancelledError:
            sent.add_done_callback(_call_off)
            raise
        if not handle.accepted:
            return GoalEnd(GoalStatus.ABORTED, {}, f"{action} refuses the goal")
        try:
            end = await self._awaited(handle.get_result_async())
        except asyncio.CancelledError:
            handle.cancel_goal_async()
            raise
        return GoalEnd(end.status, to_table(end.result))

    async def _server(self, action: str, kind: str) -> tuple[Any, Any]:
        from rclpy.action import ActionClient

        made = type_named(kind)
        if action not in self._actions:
            self._actions[action] = ActionClient(self._node, made, action)
        client = self._actions[action]
        latest = self._loop.time() + SERVER_S
        while not client.server_is_ready():
            if self._loop.time() > latest:
                raise LinkError(f"nobody serves {action}")
            await asyncio.sleep(LOOK_S)
        server = action, self._serving(action)
        if server not in self._met:
            await self._meet(action)
            self._met.add(server)
        return client, made

    def _serving(self, action: str) -> Server:
        told = self._node.get_publishers_info_by_topic(f"{action}/_action/status")
        return frozenset(bytes(one.endpoint_gid) for one in told)

    async def _meet(self, action: str) -> None:
        """Wait until the server of an action has found who asks it; its answers are lost before.

        What a node has is found in the order in which it was made, so once a client that is newer
        than the action's is answered, the action's will be. It asks to cancel a goal that is none.
        """
        kind = type_named("action_msgs/srv/CancelGoal")
        asker = self._node.create_client(kind, f"{action}/_action/cancel_goal")
        none = {"goal_info": {"goal_id": {"uuid": np.frombuffer(uuid4().bytes, np.uint8)}}}
        try:
            await asyncio.sleep(MATCHING_S)
            latest = self._loop.time() + MEETING_S
            while self._loop.time() < latest:
                with suppress(TimeoutError):
                    async with asyncio.timeout(AGAIN_S):
                        await self._awaited(asker.call_async(fill(kind.Request(), none)))
                        return
            log.warning("%s does not answer: I send it a goal nevertheless", action)
        finally:
            self._node.destroy_client(asker)

    async def _awaited(self, future: Any) -> Any:
        """The result of one of rclpy's futures."""
        done: asyncio.Future[Any] = self._loop.create_future()

        def settle(ended: Any) -> None:
            self._loop.call_soon_threadsafe(_settle, done, ended)

        future.add_done_callback(settle)
        return await done

    def subscribe(
        self, topic: str, kind: str, receive: Receive, *, urgent: bool = False
    ) -> Callable[[], None]:
        """Be given all messages of a topic, in the quality in which they are published.

        Topics do not wait for one another here, so all is urgent.
        """

        def take(message: Any) -> None:
            self._loop.call_soon_threadsafe(_give, receive, message)

        made = type_named(kind)
        subscription = self._node.create_subscription(made, topic, take, self._quality(topic))
        return lambda: self._node.destroy_subscription(subscription) and None

    def _quality(self, topic: str) -> Any:
        """What those who publish offer; kept messages are wanted where all keep them."""
        from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

        offered = [one.qos_profile for one in self._node.get_publishers_info_by_topic(topic)]
        fixed = topic.endswith("/tf_static")  # of which nobody may be known yet
        kept = fixed or _all(offered, "durability", "TRANSIENT_LOCAL")
        reliable = fixed or _all(offered, "reliability", "RELIABLE")
        return QoSProfile(
            depth=DEPTH,
            durability=DurabilityPolicy.TRANSIENT_LOCAL if kept else DurabilityPolicy.VOLATILE,
            reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        )

    def publish(self, topic: str, kind: str, message: Message) -> None:
        """Publish a message."""
        made = type_named(kind)
        if topic not in self._publishers:
            self._publishers[topic] = self._node.create_publisher(made, topic, DEPTH)
        self._publishers[topic].publish(fill(made(), message))

    async def close(self) -> None:
        """Leave the graph."""
        self._context.try_shutdown()  # which ends the spinning
        await asyncio.to_thread(self._spinning.join, 1.0)
        if not self._spinning.is_alive():
            self._executor.shutdown(timeout_sec=0.5)
            self._node.destroy_node()


async def _greet(greeting: Callable[[], Awaitable[None]]) -> None:
    try:
        await greeting()
    except Exception as error:
        log.warning("the robot was not greeted: %s", in_words(error))


def _call_off(sent: Any) -> None:
    if sent.exception() is None and sent.result().accepted:
        sent.result().cancel_goal_async()


def _settle(done: "asyncio.Future[Any]", ended: Any) -> None:
    if done.done():
        return
    if (error := ended.exception()) is not None:
        done.set_exception(LinkError(in_words(error)))
    else:
        done.set_result(ended.result())


def _give(receive: Receive, message: Any) -> None:
    try:
        receive(to_table(message))
    except Exception as error:
        log.info("there came a message that I cannot use: %s", in_words(error))


def _all(offered: list[Any], what: str, wanted: str) -> bool:
    return bool(offered) and all(getattr(one, what).name == wanted for one in offered)
