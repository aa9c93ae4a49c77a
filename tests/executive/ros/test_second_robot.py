"""A robot with other names and encodings keeps the contracts by its profile alone."""

import math
import threading
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from datetime import datetime, timedelta
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from linking import link_to
from patience import until
from second_robot import ACTIONS, PROFILE, SecondRobot

from executive.events import Inbox
from executive.ros.camera import LateError
from executive.ros.connection import Connection
from executive.ros.link import LinkError
from executive.testing.bench import four_rooms
from executive.testing.contracts.camera import CameraBench, CameraContract
from executive.testing.contracts.requests import end_of
from executive.testing.contracts.robot import Bench, RobotContract
from executive.types.goals import DriveTo, Halt, LookAt
from executive.types.results import Failed, Succeeded


@dataclass
class Linked:
    there: SecondRobot
    here: Connection
    inbox: Inbox
    bench: Bench


@pytest.fixture
def profile() -> Path:
    return PROFILE


@pytest.fixture
def linked(profile: Path) -> Iterator[Linked]:
    inbox, start = Inbox(), four_rooms().robot_start
    with SecondRobot(start) as there, link_to(there.url, inbox, profile) as here:

        def moving() -> tuple[str, ...]:
            return ("base",) if there.speed else ()

        yield Linked(there, here, inbox, Bench(here.robot, inbox, there.advance, moving=moving))


class TestSecondRobot(RobotContract):
    @pytest.fixture
    def bench(self, linked: Linked) -> Bench:
        return linked.bench


class TestSecondCamera(CameraContract):
    @pytest.fixture
    def camera_bench(self, linked: Linked) -> CameraBench:
        x, y, _ = linked.there.at
        return CameraBench(linked.here.camera, robot_at=(x, y))


def test_its_profile_is_short_and_there_is_no_python() -> None:
    lines = [line for line in PROFILE.read_text().splitlines() if line.strip()]
    assert len(lines) <= 40


def test_blue_comes_as_blue(linked: Linked) -> None:
    assert linked.here.camera.capture().color[0, 0].tolist() == [0, 0, 200]


def test_a_picture_that_cannot_be_read_is_told_with_its_fault(linked: Linked) -> None:
    linked.there.told["/acme/lens"] = {"height": "high"}
    with pytest.raises(LinkError, match="its picture cannot be read: ValueError: .*'high'"):
        linked.here.camera.capture()


def test_a_goal_looks_as_the_profile_has_it(linked: Linked) -> None:
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
    [(action, goal)] = linked.there.goals
    x, y, _ = four_rooms().stand("desk")
    assert action == "/acme/go"
    assert goal["hurry"] is True
    assert goal["where"]["header"]["frame_id"] == "world"
    assert goal["where"]["pose"]["position"] == {"x": x, "y": y, "z": 0.0}


def tells_no_more_where_it_is(there: SecondRobot) -> None:
    """It says again and again what it said last."""
    there.told["/tf"] = there._frames()


def test_a_drive_that_is_said_to_have_got_there_has_not_if_the_robot_is_elsewhere(
    linked: Linked, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("executive.ros.deeds.TOLD_S", 0.1)
    tells_no_more_where_it_is(linked.there)
    apart = math.dist(linked.there.at[:2], four_rooms().stand("desk")[:2])
    result = linked.bench.do(DriveTo("desk"))
    assert result == Failed(
        f"my drive says that I am at the desk, but I am {apart:.1f} m away from there"
    )
    assert isinstance(linked.bench.do(LookAt("desk")), Failed)


def test_where_it_got_to_may_be_told_after_that(linked: Linked) -> None:
    tells_no_more_where_it_is(linked.there)
    request = linked.bench.robot.start(DriveTo("desk"))
    until(lambda: linked.there.goals and not linked.there.busy, "the end of the drive")
    linked.there.told.clear()
    assert linked.bench.end_of(request) == Succeeded()


def test_a_picture_waits_for_where_it_was_taken(linked: Linked) -> None:
    tells_no_more_where_it_is(linked.there)
    linked.bench.wait(1.0)
    told = threading.Timer(1.5, linked.there.told.clear)
    told.start()
    linked.here.camera.capture()
    told.join()


class TestHurriedPictures:
    @pytest.fixture
    def profile(self, tmp_path: Path) -> Path:
        file = tmp_path / "hurried.toml"
        file.write_text(PROFILE.read_text().replace("[camera]", "[camera]\nlate_s = 0.5"))
        return file

    def test_they_do_not_wait_for_longer_than_they_may_take(self, linked: Linked) -> None:
        tells_no_more_where_it_is(linked.there)
        linked.bench.wait(1.0)
        with pytest.raises(LateError, match="not told in 0.5 s where eye was in world then"):
            linked.here.camera.capture()


class TestLegs:
    @pytest.fixture
    def profile(self, tmp_path: Path) -> Path:
        file = tmp_path / "legs.toml"
        legs = 'silent_s = 3.0\npath = "/acme/way"\nleg_m = 1.5'
        file.write_text(PROFILE.read_text().replace("silent_s = 3.0", legs))
        return file

    def test_a_drive_goes_in_legs_that_end_where_it_should(self, linked: Linked) -> None:
        began = linked.there.at[:2]
        assert linked.bench.do(DriveTo("desk")) == Succeeded()
        goals = [goal["where"]["pose"] for action, goal in linked.there.goals if "where" in goal]
        ends = [(pose["position"]["x"], pose["position"]["y"]) for pose in goals]
        legs = [math.dist(a, b) for a, b in pairwise([began, *ends])]
        assert len(legs) > 2
        assert max(legs) < 1.5 * 1.5 + 0.1
        assert ends[-1] == pytest.approx(four_rooms().stand("desk")[:2])


LATER = [f"{datetime.now() + timedelta(hours=hours):%H:%M}" for hours in (8, 16)]


@pytest.mark.parametrize(
    ("limits", "place", "said"),
    [
        ('rooms = ["lobby"]', "cabinet_kitchen", "I may not go into the kitchen"),
        (f"hours = {LATER}", "desk", f"I may only drive from {LATER[0]} to {LATER[1]}"),
    ],
)
class TestLimits:
    @pytest.fixture
    def profile(self, tmp_path: Path, limits: str) -> Path:
        file = tmp_path / "limits.toml"
        file.write_text(f"{PROFILE.read_text()}\n[limits]\n{limits}\n")
        return file

    def test_they_are_kept_in_words(self, linked: Linked, place: str, said: str) -> None:
        assert linked.bench.do(DriveTo(place)) == Failed(said)
        assert not linked.there.goals


def test_fingers_that_something_keeps_open_hold_it(linked: Linked) -> None:
    assert linked.here.robot.holding is False
    linked.there.holds = "mug"
    until(lambda: linked.here.robot.holding is True, "what it feels")


def test_fingers_that_tell_no_number_do_not_tell_that_nothing_is_held(linked: Linked) -> None:
    assert linked.here.robot.holding is False
    linked.there.told["/acme/fingers"] = {"position": np.array([math.nan])}
    until(lambda: linked.here.robot.holding is None, "what it does not tell")


def test_an_action_that_never_answers_is_given_up(linked: Linked) -> None:
    linked.there.deaf.add("/acme/go")
    result = linked.bench.do(DriveTo("desk"))
    assert isinstance(result, Failed)
    assert "no sign of /acme/go" in result.reason


def test_what_cannot_be_stopped_is_said(linked: Linked) -> None:
    linked.there.stubborn.add("/acme/go")
    linked.here.robot.start(DriveTo("desk"))
    until(lambda: linked.there.speed, "the drive")
    result = linked.bench.do(Halt())
    assert isinstance(result, Failed)
    assert "cannot stop my base" in result.reason


def test_a_halt_that_is_lost_on_its_way_is_told_again(linked: Linked) -> None:
    linked.here.robot.start(DriveTo("desk"))
    until(lambda: linked.there.busy, "the drive")
    linked.there.unheard = len(ACTIONS) + 1  # of each action, and of its goal
    assert linked.bench.do(Halt()) == Succeeded()
    assert not linked.there.unheard
    assert not linked.there.busy


def test_a_halt_without_a_link_does_not_pretend() -> None:
    inbox, switched_on = Inbox(), ExitStack()
    there = switched_on.enter_context(SecondRobot(four_rooms().robot_start))
    with link_to(there.url, inbox) as here:
        switched_on.close()
        result = end_of(inbox, here.robot.start(Halt()))
    assert isinstance(result, Failed)
    assert "I cannot be told to stop, and may go on" in result.reason


def test_what_nobody_remembers_is_stopped_when_there_is_a_link_again(linked: Linked) -> None:
    linked.here.robot.start(DriveTo("desk"))
    until(lambda: linked.there.busy, "the drive")
    linked.there.cut()
    until(lambda: not linked.there.busy and not linked.there.speed, "rest")


def test_a_bridge_that_has_just_begun_is_asked_again_until_all_is_stopped(linked: Linked) -> None:
    linked.here.robot.start(DriveTo("desk"))
    until(lambda: linked.there.busy, "the drive")
    linked.there.undiscovered = 5
    linked.there.cut()
    until(lambda: not linked.there.undiscovered and not linked.there.busy, "rest")


def test_after_a_loss_it_drives_on(linked: Linked) -> None:
    began = len(linked.there.headers)
    linked.there.cut()
    until(lambda: len(linked.there.headers) > began, "another link")
    assert linked.bench.do(DriveTo("desk")) == Succeeded()


def test_nonsense_from_the_other_side_changes_nothing(linked: Linked) -> None:
    for packet in ("nonsense", "[]", b"\xff\x00", '{"op": "publish", "topic": "/tf", "msg": {}}'):
        linked.there.say(packet)
    assert linked.bench.do(DriveTo("desk")) == Succeeded()
