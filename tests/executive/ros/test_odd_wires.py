"""Over a network that delays, cuts, halves and reorders, every goal ends and the robot stops."""

from collections.abc import Iterator

import pytest
from odd_wire import Mischief, OddWire
from patience import until
from second_robot import PROFILE, SPEED_M_S, SecondRobot

from executive.events import Inbox
from executive.loop import HALTS
from executive.ros.address import read_address
from executive.ros.connection import Connection, connect
from executive.ros.profile import load_profile
from executive.testing.bench import four_rooms
from executive.testing.contracts.robot import Bench
from executive.types import DriveTo, Halt, LookAt, Succeeded
from sim.fake import straight_s

CASES = {
    "delays": Mischief(delay=0.05),
    "cuts": Mischief(cut=0.004),
    "halves": Mischief(halve=0.05),
    "reorders": Mischief(swap=0.1),
    "all of it": Mischief(delay=0.02, cut=0.002, halve=0.02, swap=0.05),
}


def straight(start: str, place: str) -> float:
    return straight_s(four_rooms(), start, place, SPEED_M_S)


@pytest.fixture(params=CASES)
def odd(request: pytest.FixtureRequest) -> Iterator[tuple[SecondRobot, OddWire, Connection, Bench]]:
    home, inbox = four_rooms(), Inbox()
    with SecondRobot(home.robot_start) as there, OddWire(there.url, seed=3) as wire:
        profile = load_profile(str(PROFILE))
        here = connect(read_address(wire.url), profile, home, inbox, PROFILE.name, straight)

        wire.mischief = CASES[request.param]
        try:
            yield there, wire, here, Bench(here.robot, inbox, there.advance)
        finally:
            here.close()


def test_every_goal_ends_and_what_moves_is_stopped(
    odd: tuple[SecondRobot, OddWire, Connection, Bench],
) -> None:
    there, wire, here, bench = odd
    for goal in (DriveTo("desk"), LookAt("desk"), DriveTo("person"), Halt(), DriveTo("desk")):
        assert bench.do(goal)
    bench.robot.start(DriveTo("person"))
    bench.wait(0.1)
    wire.mischief = Mischief()
    bench.wait(2.0)
    until(lambda: not here.line.link.loss, "the link")
    assert Succeeded() in [bench.do(Halt()) for _ in range(HALTS)]
    assert not there.busy
    assert not there.speed
