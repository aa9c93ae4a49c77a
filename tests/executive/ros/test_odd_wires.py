"""Over a network that delays, cuts, halves and reorders, every goal ends and the robot stops."""

from collections.abc import Iterator

import pytest
from linking import link_to
from odd_wire import Mischief, OddWire
from patience import until
from second_robot import SecondRobot

from executive.events import Inbox
from executive.loop import HALTS
from executive.ros.connection import Connection
from executive.testing.bench import four_rooms
from executive.testing.contracts.robot import Bench
from executive.types.goals import DriveTo, Halt, LookAt
from executive.types.results import Succeeded

CASES = {
    "delays": Mischief(delay=0.05),
    "cuts": Mischief(cut=0.004),
    "halves": Mischief(halve=0.05),
    "reorders": Mischief(swap=0.1),
    "all of it": Mischief(delay=0.02, cut=0.002, halve=0.02, swap=0.05),
}


@pytest.fixture(params=CASES)
def odd(request: pytest.FixtureRequest) -> Iterator[tuple[SecondRobot, OddWire, Connection, Bench]]:
    inbox, start = Inbox(), four_rooms().robot_start
    with (
        SecondRobot(start) as there,
        OddWire(there.url, seed=3) as wire,
        link_to(wire.url, inbox) as here,
    ):
        wire.mischief = CASES[request.param]
        yield there, wire, here, Bench(here.robot, inbox, there.advance)


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
