"""Each operation of the wire, from a client that speaks it by hand."""

from collections.abc import Iterator

import numpy as np
import pytest
from served import TYPES, ZERO, Raw, look_goal, pick_goal, place_goal, pose_goal, served

from executive.perception.tags import read
from executive.ros.packets import octets
from executive.ros.png import from_png
from executive.testing.bench import four_rooms
from sim.served.offered import GRAPH
from sim.served.simulation import Simulation

DRIVE, LOOK = "/navigate_to_pose", "/head_controller/point_head_action"
COLOR, DEPTH, LENS = (
    "/camera/color/image_raw",
    "/camera/depth/image_raw",
    "/camera/color/camera_info",
)
SLOW = 1.0
"""Simulated seconds in a real one: a drive of some seconds can be called off."""


@pytest.fixture
def slow() -> Iterator[Raw]:
    with served(speed=SLOW) as simulation, Raw(simulation) as raw:
        yield raw


# --- goals ---


def test_a_goal_is_reached_and_its_sender_hears_how_it_gets_on(client: Raw) -> None:
    end = client.do(DRIVE, place_goal("desk"))
    assert (end["status"], end["result"]) == (4, True)
    assert end["values"] == {"error_code": 0, "error_msg": ""}
    assert any(said["op"] == "action_feedback" for said in client.heard)


def test_who_does_not_ask_for_feedback_hears_only_the_end(client: Raw) -> None:
    id = client.pursue(DRIVE, place_goal("person"), feedback=False)
    client.end_of(id)
    assert [said["op"] for said in client.heard] == ["action_result"]


def test_the_state_is_told_before_the_end(client: Raw) -> None:
    topics = ["/clock", "/tf", "/odom", "/joint_states", "/hand/holding"]
    for topic in topics:
        client.subscribe(topic)
    client.do(DRIVE, place_goal("desk"))
    assert [said.get("topic") for said in client.heard[-6:]] == [*topics, None]
    assert client.heard[-6]["msg"]["clock"] == client.heard[-4]["msg"]["header"]["stamp"]


def test_what_cannot_be_done_ends_as_aborted_in_words(client: Raw) -> None:
    end = client.do("/pick", pick_goal("mug", []))
    assert (end["status"], end["values"]["error_code"]) == (6, 1)
    assert end["values"]["error_msg"] == "the mug is out of reach"
    assert end["values"]["lost"] is False


@pytest.mark.parametrize(
    ("action", "goal", "why"),
    [
        (DRIVE, {}, "without pose"),
        (DRIVE, {"pose": 7}, "without pose"),
        (DRIVE, pose_goal(1.0, 2.0, frame="base_link"), "in the frame base_link"),
        (DRIVE, pose_goal(1e9, 2.0), "beyond 1000"),
        (LOOK, {"target": {"header": {"frame_id": "map"}}}, "without point"),
        ("/pick", {"label": "mug"}, "without points"),
        ("/pick", {**pick_goal("mug", [(1, 1, 1)]), "label": ""}, "is no name"),
        ("/place", {"place": ["desk"]}, "is no name"),
    ],
)
def test_a_goal_that_is_none_is_refused_in_words(
    client: Raw, action: str, goal: dict[str, object], why: str
) -> None:
    end = client.do(action, goal)
    assert (end["status"], end["result"]) == (0, False)
    assert why in end["values"]


def test_an_action_that_is_not_there_refuses_too(client: Raw) -> None:
    id = client.say("send_action_goal", action="/fly", action_type="a/action/Fly", args={})
    assert "there is no action /fly" in client.end_of(id)["values"]
    id = client.say("send_action_goal", action=DRIVE, action_type="a/action/Fly", args={})
    assert TYPES[DRIVE] in client.end_of(id)["values"]


def test_a_new_goal_replaces_the_one_before(slow: Raw) -> None:
    first = slow.pursue(DRIVE, place_goal("desk"))
    second = slow.pursue(LOOK, look_goal("desk"))
    end = slow.end_of(first)
    assert (end["status"], end["values"]["error_msg"]) == (6, "replaced by another goal")
    assert slow.end_of(second)["status"] == 4


# --- stopping ---


def test_a_goal_is_cancelled_by_its_sender(slow: Raw) -> None:
    id = slow.pursue(DRIVE, place_goal("desk"))
    slow.hear_of("action_feedback")
    slow.say("cancel_action_goal", action=DRIVE, id=id)
    assert slow.end_of(id)["status"] == 5


def test_anybody_cancels_all_goals_of_an_action_by_its_hidden_service(slow: Raw) -> None:
    id = slow.pursue(DRIVE, place_goal("desk"))
    slow.hear_of("action_feedback")
    answer = slow.told(f"{DRIVE}/_action/cancel_goal", goal_info=ZERO)
    assert answer["return_code"] == 0
    assert len(answer["goals_canceling"]) == 1
    assert slow.end_of(id)["status"] == 5
    assert slow.told(f"{DRIVE}/_action/cancel_goal", goal_info=ZERO)["goals_canceling"] == []


def test_a_goal_is_cancelled_by_what_its_feedback_calls_it(slow: Raw) -> None:
    slow.say("subscribe", topic=f"{DRIVE}/_action/feedback")
    id = slow.pursue(DRIVE, place_goal("desk"))
    uuid = slow.hear_of("publish")["msg"]["goal_id"]
    info = {"goal_id": uuid, "stamp": {"sec": 0, "nanosec": 0}}
    assert len(slow.told(f"{DRIVE}/_action/cancel_goal", goal_info=info)["goals_canceling"]) == 1
    assert slow.end_of(id)["status"] == 5


def test_to_cancel_a_goal_that_nobody_knows_says_so(client: Raw) -> None:
    info = {"goal_id": {"uuid": [1] * 16}, "stamp": {"sec": 0, "nanosec": 0}}
    assert client.told(f"{DRIVE}/_action/cancel_goal", goal_info=info)["return_code"] == 2


@pytest.mark.parametrize("info", [7, {"goal_id": {"uuid": [1]}}, {"stamp": {"sec": "now"}}])
def test_a_cancel_that_is_none_cancels_nothing(slow: Raw, info: object) -> None:
    id = slow.pursue(DRIVE, place_goal("coffee_table"))
    assert not slow.call(f"{DRIVE}/_action/cancel_goal", goal_info=info)["result"]
    assert slow.end_of(id)["status"] == 4


def test_when_a_cancelled_goal_has_ended_nothing_moves(slow: Raw) -> None:
    id = slow.pursue(DRIVE, place_goal("desk"))
    slow.hear_of("action_feedback")
    assert slow.subscribe("/odom")["twist"]["twist"]["linear"]["x"] > 0
    slow.told(f"{DRIVE}/_action/cancel_goal", goal_info=ZERO)
    slow.end_of(id)
    last = [said["msg"] for said in slow.heard if said.get("topic") == "/odom"][-1]
    assert last["twist"]["twist"]["linear"]["x"] == 0.0


# --- several clients ---


def test_the_goal_of_a_client_that_is_gone_goes_on_until_another_cancels_it() -> None:
    with served(speed=SLOW) as robot:
        with Raw(robot) as first:
            first.pursue(DRIVE, place_goal("desk"))
            first.hear_of("action_feedback")
        with Raw(robot) as second:
            assert second.subscribe("/odom")["twist"]["twist"]["linear"]["x"] > 0
            answer = second.told(f"{DRIVE}/_action/cancel_goal", goal_info=ZERO)
            assert len(answer["goals_canceling"]) == 1
            while second.hear_of("publish")["msg"]["twist"]["twist"]["linear"]["x"]:
                pass


def test_each_client_hears_of_its_own_goals_and_both_of_the_topics(robot: Simulation) -> None:
    with Raw(robot) as one, Raw(robot) as other:
        other.subscribe("/odom")
        one.do(DRIVE, place_goal("high_table"))
        x, y, _ = four_rooms().stand("high_table")
        while True:
            position = other.hear_of("publish", topic="/odom")["msg"]["pose"]["pose"]["position"]
            if (position["x"], position["y"]) == (x, y):
                break
        assert all(said["op"] == "publish" for said in other.heard)


# --- topics ---


@pytest.mark.parametrize(
    "topic", ["/clock", "/tf", "/tf_static", "/odom", "/joint_states", "/hand/holding", LENS]
)
def test_who_subscribes_is_told_at_once_how_it_is(client: Raw, topic: str) -> None:
    assert client.subscribe(topic)


def test_who_subscribes_once_more_is_told_at_once_again(client: Raw) -> None:
    assert [client.subscribe(DEPTH, id=id)["encoding"] for id in ("one", "other")] == ["32FC1"] * 2


def test_who_unsubscribes_hears_no_more(client: Raw) -> None:
    client.subscribe("/odom", id="mine")
    client.say("unsubscribe", topic="/odom", id="mine")
    client.told("/rosapi/nodes")
    client.heard.clear()
    client.do(DRIVE, place_goal("person"))
    assert all(said["op"] != "publish" for said in client.heard)


def test_of_two_subscriptions_of_a_client_one_may_end(client: Raw) -> None:
    client.subscribe("/clock", id="one")
    client.say("subscribe", topic="/clock", id="other")
    client.say("unsubscribe", topic="/clock", id="one")
    client.do(DRIVE, place_goal("desk"))
    assert sum(said["op"] == "publish" for said in client.heard) > 2


def test_a_topic_that_is_not_there_or_of_another_type_is_told_of(client: Raw) -> None:
    client.say("subscribe", topic="/scan")
    assert "there is no such topic" in client.hear_of("status")["msg"]
    client.say("subscribe", topic="/odom", type="sensor_msgs/Image")
    assert "nav_msgs/msg/Odometry" in client.hear_of("status")["msg"]
    assert client.subscribe("/odom", type="nav_msgs/Odometry")


def test_who_wants_to_hear_seldom_hears_seldom(client: Raw) -> None:
    client.subscribe("/clock", throttle_rate=60_000)
    client.do(DRIVE, place_goal("person"))
    assert sum(said["op"] == "publish" for said in client.heard) == 1


@pytest.mark.parametrize("compression", ["none", "cbor"])
def test_a_picture_shows_what_is_in_view_with_its_depth_and_lens(
    client: Raw, compression: str
) -> None:
    client.do(DRIVE, place_goal("counter_wagon"))
    client.do(LOOK, look_goal("counter_wagon"))
    color, depth, lens = (
        client.subscribe(topic, compression=compression) for topic in (COLOR, DEPTH, LENS)
    )
    assert color["header"] == depth["header"] == lens["header"]
    assert (color["encoding"], depth["encoding"]) == ("rgb8", "32FC1")
    assert (color["height"], color["width"]) == (lens["height"], lens["width"])
    pixels, metres = (octets(message["data"]) for message in (color, depth))
    picture = np.frombuffer(pixels, np.uint8).reshape(color["height"], color["width"], 3)
    assert four_rooms().placement[read(picture[8:24, 8:24])] == "counter_wagon"
    assert set(np.frombuffer(metres, "<f4").tolist()) == {1.0}
    assert lens["k"][0] == 125.0


def test_a_message_comes_as_a_picture_if_that_is_wanted(client: Raw) -> None:
    client.say("subscribe", topic="/odom", compression="png")
    assert from_png(client.hear_of("png")["data"]).startswith('{"op":"publish","topic":"/odom"')


def test_a_message_comes_as_ros_packs_it_if_that_is_wanted(client: Raw) -> None:
    raw = client.subscribe("/hand/holding", compression="cbor-raw")
    assert raw["bytes"] == b"\x00\x01\x00\x00\x00"
    assert raw["secs"] == client.told("/rosapi/get_time")["time"]["sec"]


def test_what_is_asked_for_twice_comes_in_the_richer_way(client: Raw) -> None:
    client.subscribe("/odom", id="text")
    client.subscribe("/odom", id="raw", compression="cbor-raw")
    client.told("/rosapi/nodes")  # what was on its way in the other way has come
    last = [said["msg"] for said in client.heard if said["op"] == "publish"][-1]
    assert "bytes" in last


def test_long_messages_come_in_parts_if_that_is_wanted(client: Raw) -> None:
    client.say("subscribe", topic="/odom", fragment_size=200)
    parts = [client.hear_of("fragment")]
    while len(parts) < parts[0]["total"]:
        parts.append(client.hear_of("fragment"))
    assert '"topic":"/odom"' in "".join(part["data"] for part in parts)


def test_parts_of_a_message_are_put_together(client: Raw) -> None:
    text = '{"op":"call_service","service":"/rosapi/nodes","id":"in parts"}'
    for number, piece in enumerate((text[:20], text[20:])):
        client.say("fragment", id="whole", data=piece, num=number, total=2)
    assert client.hear_of("service_response", id="in parts")["result"]


def test_the_robot_takes_no_messages(client: Raw) -> None:
    client.say("publish", topic="/odom", msg={})
    assert "takes no messages" in client.hear_of("status")["msg"]


def test_who_does_not_want_to_be_told_what_is_wrong_is_not(client: Raw) -> None:
    client.say("set_level", level="none")
    client.say("subscribe", topic="/scan")
    assert client.hears_nothing()


# --- what there is ---


def test_the_robot_tells_what_it_offers(client: Raw) -> None:
    topics = client.told("/rosapi/topics")
    kinds = dict(zip(topics["topics"], topics["types"], strict=True))
    assert kinds[COLOR] == "sensor_msgs/msg/Image"
    assert kinds[f"{DRIVE}/_action/feedback"] == f"{TYPES[DRIVE]}_FeedbackMessage"
    assert set(client.told("/rosapi/action_servers")["action_servers"]) == set(GRAPH.actions)
    services = client.told("/rosapi/services")["services"]
    assert f"{DRIVE}/_action/cancel_goal" in services
    assert TYPES[DRIVE] in client.told("/rosapi/interfaces")["interfaces"]


@pytest.mark.parametrize(
    ("service", "request_", "response"),
    [
        ("topic_type", {"topic": "/odom"}, {"type": "nav_msgs/msg/Odometry"}),
        ("topic_type", {"topic": "/nothing"}, {"type": ""}),
        ("topics_for_type", {"type": "nav_msgs/msg/Odometry"}, {"topics": ["/odom"]}),
        ("service_type", {"service": "/rosapi/nodes"}, {"type": "rosapi_msgs/srv/Nodes"}),
        ("action_type", {"action": DRIVE}, {"type": TYPES[DRIVE]}),
        ("publishers", {"topic": "/odom"}, {"publishers": ["/robot_executive_sim"]}),
        ("subscribers", {"topic": "/odom"}, {"subscribers": []}),
        ("service_node", {"service": "/rosapi/nodes"}, {"node": "/robot_executive_sim"}),
        ("get_ros_version", {}, {"version": 2, "distro": "simulated"}),
        ("get_param_names", {}, {"names": []}),
    ],
)
def test_the_robot_answers_what_rosapi_answers(
    client: Raw, service: str, request_: dict[str, str], response: dict[str, object]
) -> None:
    assert client.told(f"/rosapi/{service}", **request_) == response


def test_what_messages_consist_of_is_told(client: Raw) -> None:
    told = client.told("/rosapi/message_details", type="sensor_msgs/Image")["typedefs"]
    assert [one["type"] for one in told[:2]] == ["sensor_msgs/Image", "std_msgs/Header"]
    assert dict(zip(told[0]["fieldnames"], told[0]["fieldarraylen"], strict=True))["data"] == 0


def test_names_may_come_without_the_first_slash(client: Raw) -> None:
    assert client.told("rosapi/topic_type", topic="odom")["type"] == "nav_msgs/msg/Odometry"


def test_a_service_that_is_not_there_fails_in_words(client: Raw) -> None:
    answer = client.call("/fly")
    assert not answer["result"]
    assert "there is no service /fly" in answer["values"]
