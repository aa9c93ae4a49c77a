"""Whoever connects: broken, hostile and greedy clients have no effect on others."""

import json
import socket

import cbor2
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from patience import PATIENCE_S
from served import Raw, place_goal, served
from websockets.exceptions import ConnectionClosed, InvalidStatus

from executive.ros import conversation, server
from sim.served.offered import GRAPH
from sim.served.simulation import Simulation

DRIVE = "/navigate_to_pose"


BROKEN = [
    "",
    "no JSON",
    "[]",
    "{}",
    "null",
    '{"op": 7}',
    '{"op": "explode"}',
    '{"op": "subscribe"}',
    '{"op": "subscribe", "topic": ["/odom"]}',
    '{"op": "subscribe", "topic": "/odom", "throttle_rate": -1}',
    '{"op": "subscribe", "topic": "/odom", "compression": "zip"}',
    '{"op": "call_service", "service": "/rosapi/topics", "args": 7}',
    '{"op": "send_action_goal", "action": "/pick"}',
    '{"op": "fragment", "id": "x", "data": "{", "num": 3, "total": 2}',
    '{"op": "service_response", "service": "/pick", "result": true}',
    "[" * 100_000,
    '{"op": "publish", "topic": "/odom", "msg": {}}',
    b"\xff\xff",
    cbor2.dumps({"op": "call_service", "service": 7}),
]


@pytest.mark.parametrize("packet", BROKEN, ids=range(len(BROKEN)))
def test_a_broken_packet_is_told_of_and_has_no_effect(client: Raw, packet: str | bytes) -> None:
    client.send(packet)
    assert client.hear()["op"] == "status"
    assert client.told("/rosapi/nodes")


PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**63), 2**64 - 1)
    | st.floats()
    | st.text(max_size=9),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4)
    ),
    max_leaves=10,
)
OPS = st.sampled_from(["subscribe", "call_service", "send_action_goal", "cancel_action_goal", "x"])
NAMES = st.sampled_from([*GRAPH.topics, *GRAPH.services, *GRAPH.actions])
FIELDS = st.sampled_from(
    ["topic", "service", "action", "action_type", "args", "id", "type", "feedback", "compression"]
)


@settings(max_examples=150, deadline=None)
@given(st.dictionaries(FIELDS, NAMES | PLAIN, max_size=6), OPS)
def test_whatever_is_said_the_robot_goes_on(fields: dict[str, object], op: str) -> None:
    with Raw(_ROBOT[0]) as raw:
        raw.send(json.dumps({**fields, "op": op}))
        assert raw.told("/rosapi/nodes")


@settings(max_examples=100, deadline=None)
@given(st.sampled_from(list(GRAPH.actions.items())), st.dictionaries(st.text(max_size=8), PLAIN))
def test_whatever_is_wanted_the_robot_goes_on(
    action: tuple[str, str], goal: dict[str, object]
) -> None:
    name, kind = action
    with Raw(_ROBOT[0]) as raw:
        id = raw.say("send_action_goal", action=name, action_type=kind, args=goal)
        assert raw.end_of(id)["status"] in (0, 6)


_ROBOT: list[Simulation] = []


@pytest.fixture(autouse=True)
def _at_hand(robot: Simulation) -> None:
    _ROBOT[:] = [robot]


def test_a_packet_that_is_too_large_ends_only_its_senders_connection(robot: Simulation) -> None:
    with Raw(robot) as other, Raw(robot) as greedy:
        greedy.send(" " * (server.MOST_BYTES + 1))
        with pytest.raises(ConnectionClosed):
            greedy.hear()
        assert other.told("/rosapi/nodes")


def test_what_is_no_websocket_is_sent_away(robot: Simulation) -> None:
    host, port = robot.server.address.removeprefix("ws://").split(":")
    with socket.create_connection((host, int(port)), timeout=PATIENCE_S) as plain:
        plain.sendall(b"\0\1\2 hello\r\n\r\n")
        assert b"101" not in plain.recv(100)
    with Raw(robot) as client:
        assert client.told("/rosapi/nodes")


@pytest.mark.parametrize("origin", ["https://example.org", "null", "http://127.0.0.1.example.org"])
def test_pages_from_elsewhere_are_refused(robot: Simulation, origin: str) -> None:
    with pytest.raises(InvalidStatus), Raw(robot, origin=origin):
        pass


@pytest.mark.parametrize("origin", ["http://localhost:8000", "https://127.0.0.1"])
def test_pages_of_this_machine_are_let_in(robot: Simulation, origin: str) -> None:
    with Raw(robot, origin=origin) as client:
        assert client.told("/rosapi/nodes")


def test_it_listens_to_this_machine_only(robot: Simulation) -> None:
    assert robot.server.address.startswith("ws://127.0.0.1:")


def test_one_client_too_many_is_sent_away(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "MOST_CLIENTS", 1)
    with served() as robot, Raw(robot) as first, Raw(robot) as second:
        assert first.told("/rosapi/nodes")
        with pytest.raises(ConnectionClosed):
            second.hear()


def test_a_client_has_so_many_subscriptions_at_most(
    client: Raw, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(conversation, "MOST_SUBSCRIPTIONS", 1)
    client.subscribe("/odom", id="one")
    client.say("subscribe", topic="/odom", id="two")
    assert "more than 1 subscription" in client.hear_of("status")["msg"]


def test_a_client_has_so_many_goals_at_most(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(conversation, "MOST_GOALS", 1)
    with served(speed=1.0) as robot, Raw(robot) as client:
        client.pursue(DRIVE, place_goal("desk"))
        refused = client.pursue(DRIVE, place_goal("person"))
        assert "more than 1 goals" in client.end_of(refused)["values"]


def test_a_client_that_reads_nothing_holds_nobody_up() -> None:
    with served() as robot, Raw(robot, max_queue=1, close_timeout=0.1) as deaf, Raw(robot) as other:
        for topic in GRAPH.published:
            deaf.say("subscribe", topic=topic)
        for place in ("desk", "person") * 10:
            assert other.do(DRIVE, place_goal(place))["status"] == 4


def test_a_goal_of_the_same_name_is_refused_while_the_first_is_under_way() -> None:
    with served(speed=1.0) as robot, Raw(robot) as client:
        client.pursue(DRIVE, place_goal("desk"), id="mine")
        client.pursue(DRIVE, place_goal("person"), id="mine")
        assert "is under way" in client.hear_of("action_result", result=False)["values"]
