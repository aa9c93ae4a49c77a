"""The served robot: its time, its faults, what it keeps to itself, and its door."""

import os
import re
import signal
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from importlib.resources import files

import pytest
from patience import PATIENCE_S
from served import Raw, look_goal, pick_goal, place_goal, pose_goal, served

from executive.errors import InputError
from executive.testing.bench import four_rooms
from sim.home.validation import with_placement
from sim.served.bodies import drive
from sim.served.offered import GRAPH
from sim.served.serving import Plan, build

DRIVE, LOOK = "/navigate_to_pose", "/head_controller/point_head_action"


def seconds(stamp: dict[str, int]) -> float:
    return stamp["sec"] + stamp["nanosec"] / 1e9


# --- time ---


def test_time_stands_while_nothing_is_under_way() -> None:
    with served() as robot, Raw(robot) as client:
        client.subscribe("/clock")
        client.do(DRIVE, place_goal("desk"))
        first, then = (client.told("/rosapi/get_time")["time"] for _ in range(2))
        assert first == then
        assert seconds(first) == pytest.approx(robot.now)
        last = [said["msg"]["clock"] for said in client.heard if said["op"] == "publish"][-1]
        assert last == first


def test_a_drive_takes_the_time_that_it_takes_in_the_same_process() -> None:
    with served() as robot, Raw(robot) as client:
        client.do(DRIVE, pose_goal(5.1, 4.1, 0.0))
        assert robot.now == pytest.approx(0.8 / 0.8)


def test_time_passes_no_faster_than_wanted() -> None:
    with served(speed=2.0) as robot, Raw(robot) as client:
        client.pursue(DRIVE, place_goal("desk"))
        client.hear_of("action_feedback")
        assert robot.now < 2.0


# --- goals ---


@pytest.mark.parametrize("place", ["desk", "person", "delivery", "counter_wagon"])
def test_the_pose_from_which_a_place_is_used_means_that_place(place: str) -> None:
    x, y, yaw = four_rooms().stand(place)
    goal = drive(four_rooms(), (x + 0.001, y, yaw + 6.2832))
    assert getattr(goal, "place", None) == place


def test_any_other_pose_is_driven_to_as_well() -> None:
    with served() as robot, Raw(robot) as client:
        assert client.do(DRIVE, pose_goal(3.0, 5.0))["status"] == 4
        assert client.subscribe("/odom")["pose"]["pose"]["position"]["x"] == 3.0


def test_a_thing_is_picked_up_and_put_down_elsewhere() -> None:
    home = with_placement(four_rooms(), {"mug": "coffee_table"})
    with served(home=home) as robot, Raw(robot) as client:
        assert client.subscribe("/hand/holding") == {"data": False}
        for place, action, goal in (
            ("coffee_table", "/pick", pick_goal("mug", [(0.1, 0.2, 0.3)])),
            ("desk", "/place", {"place": "desk"}),
        ):
            assert client.do(DRIVE, place_goal(place))["status"] == 4
            assert client.do(LOOK, look_goal(place))["status"] == 4
            assert client.do(action, goal)["status"] == 4
        told = [said["msg"]["data"] for said in client.heard if said.get("topic")]
        assert True in told
        assert told[-1] is False


# --- faults ---


def test_what_goes_wrong_by_order_is_felt_by_who_drives_and_told_to_who_serves() -> None:
    struck: list[str] = []
    with served(struck.append, faults=["slip=1"]) as robot, Raw(robot) as client:
        client.do(DRIVE, place_goal(four_rooms().placement["mug"]))
        end = client.do("/pick", pick_goal("mug", []))
        assert end["values"]["error_msg"] == "the mug slipped from my fingers"
    assert struck == ["slip=1: the fingers slip"]


def test_a_drop_on_the_way_is_told_as_such() -> None:
    with served(faults=["drop"]) as robot, Raw(robot) as client:
        client.subscribe("/hand/holding")
        client.do(DRIVE, place_goal(four_rooms().placement["mug"]))
        client.do("/pick", pick_goal("mug", []))
        end = client.do(DRIVE, place_goal("person"))
        assert (end["status"], end["values"]["error_msg"]) == (6, "the mug fell from my hand")
        assert client.heard[-2]["msg"] == {"data": False}


def test_a_blind_camera_is_black() -> None:
    with served(faults=["blind"]) as robot, Raw(robot) as client:
        picture = client.subscribe("/camera/color/image_raw", compression="cbor")
        assert set(picture["data"]) == {0}


@pytest.mark.parametrize(
    ("fault", "why"),
    [("miss=0.2", "is seen by who gets them"), ("crate=1,1", "physics"), ("fire", "no fault")],
)
def test_faults_that_cannot_be_are_refused(fault: str, why: str) -> None:
    with pytest.raises(InputError, match=why):
        build(Plan(four_rooms(), "fake", faults=[fault]))


# --- what it says of itself ---


def test_the_packaged_profile_is_of_what_is_offered() -> None:
    text = files("executive").joinpath("ros/profiles/served.toml").read_text()
    tables = [table for table in tomllib.loads(text).values() if isinstance(table, dict)]
    named = {table["action"]: table["type"] for table in tables if "action" in table}
    assert named == GRAPH.actions
    names = {str(value) for table in tables for value in table.values()}
    assert {name for name in names if name.startswith("/")} <= {*GRAPH.topics, *GRAPH.actions}


def test_a_port_that_is_taken_is_told_of() -> None:
    with served() as robot:
        port = int(robot.server.address.rpartition(":")[2])
        other = build(Plan(four_rooms(), "fake", port=port))
        with pytest.raises(InputError, match=f"--port {port}: cannot listen"):
            other.server.listen()
        other.close()


# --- the door ---


@pytest.fixture
def process() -> Iterator["subprocess.Popen[str]"]:
    options = ["--world", "fake", "--port", "0", "--fault", "moved=mug:desk@1"]
    command = [sys.executable, "-m", "sim", "serve", *options]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as started:
        yield started
        started.kill()


def test_it_is_served_from_the_command_line_until_somebody_says_stop(
    process: "subprocess.Popen[str]",
) -> None:
    assert process.stdout is not None
    line = process.stdout.readline()
    assert re.fullmatch(
        r"the robot of four_rooms is at ws://127\.0\.0\.1:\d+ \(Ctrl-C ends that\)\n", line
    )
    process.send_signal(signal.SIGINT)
    assert process.wait(PATIENCE_S) == 130


def test_it_goes_on_when_nobody_reads_what_it_tells(process: "subprocess.Popen[str]") -> None:
    assert process.stdout is not None
    address = next(word for word in process.stdout.readline().split() if "://" in word)
    process.stdout.close()
    with Raw(address) as client:
        assert client.do(DRIVE, place_goal("desk"))["status"] == 4
        assert client.told("/rosapi/nodes")
