"""A link that is lost during a drive or a look is waited for, and the goal is done again."""

import asyncio
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from linking import link_to
from patience import until
from second_robot import PROFILE, SecondRobot

from executive.errors import UnreachableError
from executive.events import Inbox
from executive.ros.connection import Connection
from executive.ros.link import LinkError
from executive.ros.losses import Losses
from executive.testing.bench import four_rooms
from executive.testing.contracts.robot import Bench, nothing_there
from executive.types.goals import DriveTo, Halt, LookAt, Pick
from executive.types.results import Failed, Result, Succeeded

LOOK = '[look]\naction = "/acme/go"\ntype = "acme_msgs/action/Go"\nsilent_s = 1.0\n'
WAIT_S = 20.0
LATE_S = 0.5


class House:
    """The second robot, its link, and a drive to its desk."""

    def __init__(self, there: SecondRobot, bench: Bench, here: Connection) -> None:
        self.there, self.bench = there, bench
        self.link, self.camera = here.line.link, here.camera

    @property
    def goals(self) -> int:
        return len(self.there.goals)

    def drive(self) -> int:
        request = self.bench.robot.start(DriveTo("desk"))
        until(lambda: self.there.busy, "the drive")
        return request

    def lose(self) -> None:
        self.there.shut = 503
        self.there.cut()
        until(lambda: self.link.loss, "the loss")

    def find(self) -> None:
        self.there.shut = None
        until(lambda: not self.link.loss, "another link")


@pytest.fixture
def wait_s() -> float:
    return WAIT_S


@pytest.fixture
def hurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """What begins without a link soon gives it up."""
    for module in ("actions", "camera"):
        monkeypatch.setattr(f"executive.ros.{module}.LINK_S", 0.1)


@pytest.fixture
def house(tmp_path: Path, wait_s: float) -> Iterator[House]:
    inbox, file = Inbox(), tmp_path / "mine.toml"
    look = f'{LOOK}goal = {{ where = {{ header = {{ frame_id = "$place" }} }} }}\n'
    rest = PROFILE.read_text().replace("[camera]", f"[camera]\nlate_s = {LATE_S}")
    file.write_text(f"link_wait_s = {wait_s}\n{rest}\n{look}")
    start = four_rooms().robot_start
    with SecondRobot(start) as there, link_to(there.url, inbox, file) as here:
        yield House(there, Bench(here.robot, inbox, there.advance), here)


def is_unreachable(result: Result) -> bool:
    return isinstance(result, Failed) and result.unreachable


def reason(result: Result) -> str:
    assert isinstance(result, Failed)
    return result.reason


def test_a_drive_is_done_again_when_there_is_a_link_again(house: House) -> None:
    request = house.drive()
    house.lose()
    house.find()
    assert house.bench.end_of(request) == Succeeded()
    assert house.goals == 2
    assert house.there.at[:2] == pytest.approx(four_rooms().stand("desk")[:2])


def test_a_drive_that_is_called_off_because_the_link_was_lost_is_done_again(house: House) -> None:
    request = house.drive()
    house.there.cut(only_stop=True)
    assert house.bench.end_of(request) == Succeeded()
    assert house.goals == 2


def test_a_look_is_done_again(house: House) -> None:
    assert house.bench.do(DriveTo("desk")) == Succeeded()
    house.there.deaf.add("/acme/go")
    request = house.bench.robot.start(LookAt("desk"))
    until(lambda: house.goals == 2, "the look")
    house.there.cut()
    assert "no sign of /acme/go" in reason(house.bench.end_of(request))
    assert house.goals == 3


def test_a_grasp_is_not_done_again(house: House) -> None:
    house.there.deaf.add("/acme/grab")
    request = house.bench.robot.start(Pick(nothing_there()))
    until(lambda: house.goals, "the grasp")
    house.there.cut()
    assert "the link to the robot was lost" in reason(house.bench.end_of(request))
    assert house.goals == 1


def test_what_falls_while_there_is_no_link_is_told(house: House) -> None:
    house.there.holds = "mug"
    until(lambda: house.bench.robot.holding is True, "what it feels")
    request = house.drive()
    house.lose()
    house.there.holds = ""
    house.find()
    assert house.bench.end_of(request) == Failed("what I held fell on the way to the desk", True)


@pytest.mark.parametrize("halts", [False, True])
def test_one_that_is_called_off_while_there_is_no_link_never_moves_again(
    house: House, halts: bool
) -> None:
    request = house.drive()
    house.lose()
    house.bench.robot.cancel(request)
    halt = house.bench.robot.start(Halt()) if halts else None
    house.find()
    if halt is not None:
        assert house.bench.end_of(halt) == Succeeded()
    until(lambda: not house.there.busy, "rest")
    house.bench.wait(0.5)
    assert house.goals == 1
    assert not house.there.speed


@pytest.mark.parametrize("wait_s", [0.3])
def test_a_link_that_does_not_come_back_is_told(house: House) -> None:
    request = house.drive()
    house.lose()
    end = house.bench.end_of(request)
    assert reason(end).startswith("I waited 0.3 s, and there is no link to the robot: ")
    assert is_unreachable(end)


@pytest.mark.parametrize("wait_s", [0.3])
def test_it_is_not_waited_for_again_neither_by_a_goal_nor_by_a_halt(
    house: House, hurried: None
) -> None:
    request = house.drive()
    house.lose()
    house.bench.end_of(request)
    for goal in (Halt(), DriveTo("sofa"), Pick(nothing_there())):
        end = house.bench.do(goal)
        assert "there is no link to the robot: " in reason(end)
        assert is_unreachable(end) == (goal != Halt())


@pytest.mark.parametrize("wait_s", [0.3])
def test_in_a_grasp_the_link_is_waited_for_too(house: House) -> None:
    house.there.deaf.add("/acme/grab")
    request = house.bench.robot.start(Pick(nothing_there()))
    until(lambda: house.goals, "the grasp")
    house.lose()
    assert is_unreachable(house.bench.end_of(request))


@pytest.mark.parametrize("wait_s", [0.3])
def test_a_picture_without_a_link_says_that_the_robot_is_gone(house: House, hurried: None) -> None:
    house.lose()
    with pytest.raises(UnreachableError, match="I waited 0.3 s"):
        house.camera.capture()


def test_a_picture_is_taken_when_there_is_a_link_again(house: House) -> None:
    with ThreadPoolExecutor() as beside:
        house.there.told["/acme/rgb"] = {"header": {"stamp": {"sec": 0, "nanosec": 0}}}
        taking = beside.submit(house.camera.capture)
        until(lambda: house.there.is_wanted("/acme/rgb"), "the wish for a picture")
        house.lose()
        house.there.told.clear()
        time.sleep(2 * LATE_S)
        house.find()
        assert taking.result().color.any()


def test_a_robot_that_was_moved_while_there_was_no_link_is_not_where_it_was(house: House) -> None:
    assert house.bench.do(DriveTo("desk")) == Succeeded()
    house.lose()
    x, y, yaw = house.there.at
    house.there.at = x + 1.0, y, yaw
    house.find()
    assert house.bench.do(LookAt("desk")) == Failed("I am not at the desk")


def test_one_that_was_not_moved_still_is(house: House) -> None:
    assert house.bench.do(DriveTo("desk")) == Succeeded()
    house.there.deaf.add("/acme/go")
    house.there.cut()
    until(lambda: house.link.losses, "the loss")
    assert "no sign of /acme/go" in reason(house.bench.do(LookAt("desk")))


@pytest.mark.parametrize("wait_s", [0])
def test_who_does_not_want_to_wait_is_told_at_once(house: House) -> None:
    request = house.drive()
    house.there.cut()
    assert "the link to the robot was lost" in reason(house.bench.end_of(request))
    assert house.goals == 1


class Gone:
    """A link that is lost and does not come back."""

    loss, losses, waits = "it broke off", 1, 0

    async def ready(self, _: float) -> None:
        self.waits += 1
        raise LinkError("there is no link")


def test_what_was_waited_for_in_vain_is_not_waited_for_with_each_goal_nor_told() -> None:
    link: Any = Gone()
    told: list[str] = []

    async def settled() -> None:
        pass

    async def attempt() -> Succeeded:
        raise LinkError("there is no link")

    losses = Losses(link, WAIT_S, settled, told.append)
    for said in ("I waited 20 s, and there is no link", "^there is no link"):
        with pytest.raises(LinkError, match=said):
            asyncio.run(losses.outlived(attempt))
    assert link.waits == 1
    assert told == ["I lost the link to my robot: I wait for it, 20 s at most."]
