"""The link by rclpy, with a real node of ROS 2: `pytest -m ros2` where rclpy is."""

import asyncio
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
from patience import PATIENCE_S, until
from ros2.spinning import spin

from executive.ros import rclpy_link
from executive.ros.link import LinkError
from executive.ros.messages import everything
from executive.ros.offers import Offers
from executive.ros.protocol import GoalStatus, Message
from executive.ros.rclpy_link import RclpyLink
from executive.ros.thread import WireThread

pytestmark = [pytest.mark.ros2, pytest.mark.filterwarnings("ignore::DeprecationWarning")]
KIND, ACTION = "test_msgs/action/Fibonacci", "/count"


class Node:
    """A node with an action that counts, a service, and topics."""

    def __init__(self) -> None:
        import rclpy
        from rclpy.executors import MultiThreadedExecutor
        from std_msgs.msg import String
        from test_msgs.action import Fibonacci
        from test_msgs.srv import BasicTypes

        self.context = rclpy.Context()
        rclpy.init(context=self.context)
        self.node = rclpy.create_node("robot", context=self.context)
        self.executor = MultiThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.refuses, self.running = False, 0
        self.made = Fibonacci
        self.server = self.serve()
        self.node.create_service(BasicTypes, "/echo", self.echo)
        self.heard: list[str] = []
        self.node.create_subscription(String, "/in", lambda said: self.heard.append(said.data), 5)
        self.out = self.node.create_publisher(String, "/out", 5)
        threading.Thread(target=spin, args=(self.executor,), daemon=True).start()

    def serve(self) -> Any:
        from rclpy.action import ActionServer, CancelResponse, GoalResponse

        return ActionServer(
            self.node,
            self.made,
            ACTION,
            execute_callback=self.count,
            goal_callback=lambda _: GoalResponse.REJECT if self.refuses else GoalResponse.ACCEPT,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def echo(self, request: Any, response: Any) -> Any:
        response.int32_value, response.string_value = request.int32_value, request.string_value
        return response

    def count(self, handle: Any) -> Any:
        self.running += 1
        result, feedback = self.made.Result(), self.made.Feedback()
        try:
            for number in range(handle.request.order):
                if handle.is_cancel_requested:
                    handle.canceled()
                    return result
                feedback.sequence = [number]
                handle.publish_feedback(feedback)
                result.sequence = [*result.sequence, number]
                time.sleep(0.02)
            handle.succeed()
            return result
        finally:
            self.running -= 1

    def close(self) -> None:
        self.executor.shutdown(timeout_sec=1.0)
        self.context.try_shutdown()


@pytest.fixture(scope="module")
def node() -> Iterator[Node]:
    pytest.importorskip("rclpy")
    made = Node()
    yield made
    made.close()


@pytest.fixture
def wire(node: Node, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[WireThread, RclpyLink]]:
    """A link that has found the node, and that the node has found."""
    monkeypatch.setattr(rclpy_link, "MATCHING_S", 2.0)
    monkeypatch.setattr(rclpy_link, "MEETING_S", PATIENCE_S)
    thread = WireThread()

    async def join() -> RclpyLink:
        return RclpyLink()

    link = thread.run(join())
    answer(thread, link, "/echo", "test_msgs/srv/BasicTypes", {})
    yield thread, link
    thread.start(link.close()).result(PATIENCE_S)
    thread.close()


def answer(
    thread: WireThread, link: RclpyLink, service: str, kind: str, request: Message
) -> Message:
    """What a service answers; an answer to whom it has not yet found is lost: it is asked again."""
    answers: list[Message] = []

    def answered() -> bool:
        with suppress(LinkError):
            asked = link.call(service, kind, request, within_s=5.0, urgent=True)
            answers.append(thread.run(asked))
        return bool(answers)

    until(answered, f"the answer of {service}")
    return answers[0]


def test_a_goal_is_pursued_with_feedback(wire: tuple[WireThread, RclpyLink]) -> None:
    thread, link = wire
    heard: list[Any] = []
    end = thread.run(link.pursue(ACTION, KIND, {"order": 3}, heard.append))
    assert end.succeeded
    assert end.values["sequence"].tolist() == [0, 1, 2]
    assert heard


def test_a_server_that_comes_back_is_met_again(
    wire: tuple[WireThread, RclpyLink], node: Node, monkeypatch: pytest.MonkeyPatch
) -> None:
    thread, link = wire
    met: list[str] = []
    meet = link._meet

    async def counted(action: str) -> None:
        met.append(action)
        await meet(action)

    monkeypatch.setattr(link, "_meet", counted)

    def pursued() -> bool:
        return thread.run(link.pursue(ACTION, KIND, {"order": 1}, lambda _: None)).succeeded

    assert pursued()
    assert pursued()
    assert met == [ACTION]
    node.server.destroy()
    node.server = node.serve()
    assert pursued()
    assert met == [ACTION, ACTION]


def test_a_goal_that_is_refused_ends_at_once(
    wire: tuple[WireThread, RclpyLink], node: Node
) -> None:
    thread, link = wire
    node.refuses = True
    end = thread.run(link.pursue(ACTION, KIND, {"order": 3}, lambda _: None))
    node.refuses = False
    assert end.status == GoalStatus.ABORTED
    assert "refuses" in end.reason


def test_the_hidden_service_cancels_all_goals(
    wire: tuple[WireThread, RclpyLink], node: Node
) -> None:
    thread, link = wire
    pursuit = thread.start(link.pursue(ACTION, KIND, {"order": 500}, lambda _: None))
    until(lambda: node.running)
    service, kind = f"{ACTION}/_action/cancel_goal", "action_msgs/srv/CancelGoal"
    assert answer(thread, link, service, kind, everything())["return_code"] == 0
    assert pursuit.result(PATIENCE_S).status == GoalStatus.CANCELED


def test_what_is_cancelled_here_is_cancelled_there(
    wire: tuple[WireThread, RclpyLink], node: Node
) -> None:
    thread, link = wire
    pursuit = thread.start(link.pursue(ACTION, KIND, {"order": 500}, lambda _: None))
    until(lambda: node.running)
    pursuit.cancel()
    until(lambda: not node.running)


def test_a_service_is_called(wire: tuple[WireThread, RclpyLink]) -> None:
    thread, link = wire
    request = {"int32_value": 7, "string_value": "so"}
    said = answer(thread, link, "/echo", "test_msgs/srv/BasicTypes", request)
    assert (said["int32_value"], said["string_value"]) == (7, "so")


def test_nobody_there_is_said(
    wire: tuple[WireThread, RclpyLink], monkeypatch: pytest.MonkeyPatch
) -> None:
    thread, link = wire
    monkeypatch.setattr(rclpy_link, "SERVER_S", 0.5)
    with pytest.raises(LinkError, match="does not answer"):
        thread.run(link.call("/nobody", "test_msgs/srv/BasicTypes", {}, within_s=0.2))
    with pytest.raises(LinkError, match="nobody serves /nothing"):
        thread.run(link.pursue("/nothing", KIND, {}, lambda _: None))


def test_messages_go_both_ways(wire: tuple[WireThread, RclpyLink], node: Node) -> None:
    thread, link = wire
    heard: list[Any] = []

    async def listen() -> None:
        link.subscribe("/out", "std_msgs/msg/String", heard.append)

    async def say() -> None:
        link.publish("/in", "std_msgs/msg/String", {"data": "hello"})

    thread.run(listen())

    def said() -> bool:
        from std_msgs.msg import String

        node.out.publish(String(data="there"))
        thread.run(say())
        return bool(heard and node.heard)

    until(said)
    assert heard[0] == {"data": "there"}
    assert node.heard[0] == "hello"


def test_what_the_robot_offers_is_told_with_types(wire: tuple[WireThread, RclpyLink]) -> None:
    thread, link = wire
    offers = [Offers({}, (), {})]

    def whole() -> bool:  # a busy machine discovers late
        offers[0] = thread.run(link.offers())
        return ACTION in offers[0].actions and "/out" in offers[0].topics

    until(whole, "what the robot offers")
    assert offers[0].actions[ACTION] == KIND
    assert offers[0].topics["/out"] == "std_msgs/msg/String"


def test_a_field_that_is_not_there_is_said(wire: tuple[WireThread, RclpyLink]) -> None:
    thread, link = wire
    with pytest.raises(LinkError, match="has no field"):
        thread.run(link.pursue(ACTION, KIND, {"oder": 3}, lambda _: None))
    with pytest.raises(LinkError, match="does not know the type"):
        thread.run(link.pursue(ACTION, "acme_msgs/action/Go", {}, lambda _: None))


def test_the_link_goes_on_after_a_fault_in_rclpy(wire: tuple[WireThread, RclpyLink]) -> None:
    thread, link = wire
    broken = threading.Event()

    def breaks() -> None:
        broken.set()
        raise SystemError("a client was gone in the wrong moment")

    link._executor.create_task(breaks)
    assert broken.wait(PATIENCE_S)
    pursuit = thread.start(link.pursue(ACTION, KIND, {"order": 1}, lambda _: None))
    assert pursuit.result(PATIENCE_S).succeeded


def test_greeting_comes_first(wire: tuple[WireThread, RclpyLink]) -> None:
    thread, link = wire
    done: list[str] = []

    async def greeting() -> None:
        await asyncio.sleep(0.1)
        done.append("greeted")

    async def greet() -> list[str]:
        link.greet_with(greeting)
        await link.ready(PATIENCE_S)
        return list(done)

    assert thread.run(greet()) == ["greeted"]
