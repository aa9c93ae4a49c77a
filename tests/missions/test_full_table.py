"""All of a table is used; and when it is full, what the robot has stays in the hand."""

import io

import pytest

from executive.app.session import Session
from executive.config import load_settings
from executive.events import Ended, Inbox
from executive.testing.bench import Notebook, four_rooms
from executive.types.goals import DriveTo, Goal, PutDown
from executive.types.outcome import MissionStatus
from executive.types.results import Failed, Result, Succeeded
from sim.fake import FakeRobot, FakeWorld


def test_what_has_no_room_stays_in_the_hand() -> None:
    inbox = Inbox()
    world = FakeWorld(four_rooms(), inbox, Notebook(), spots=1)
    robot = FakeRobot(world)
    world.held = world.things.popitem()[0]
    full, empty = world.things[next(iter(world.things))], "delivery"
    assert do(robot, world, DriveTo(full)) == Succeeded()
    assert do(robot, world, PutDown(full)) == Failed(f"there is no free spot on the {full}")
    assert robot.holding
    assert do(robot, world, DriveTo(empty)) == Succeeded()
    assert do(robot, world, PutDown(empty)) == Succeeded()
    assert not robot.holding


def do(robot: FakeRobot, world: FakeWorld, goal: Goal) -> Result:
    robot.start(goal)
    while not world.inbox.has_events:
        world.advance(100.0)
    (event,) = world.inbox.take_all()
    assert isinstance(event, Ended)
    return event.result


@pytest.mark.physics
def test_three_things_are_brought_to_one_table() -> None:
    settings = load_settings(llm="none", knowledge="okb", user="oracle", seed=1, camera_hz=0.0)
    session = Session(settings, out=io.StringIO(), recorded=False)
    things = ("banana", "hammer", "apple")
    outcomes = [session.run(f"Bring a {thing}") for thing in things]
    assert [outcome.status for outcome in outcomes] == [MissionStatus.DONE] * len(things)
    assert {session.world.resting_place(thing) for thing in things} == {"delivery"}
    session.close()
