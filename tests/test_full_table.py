"""In the instant world, too, a piece of furniture may be full."""

from conftest import Notebook, four_rooms

from executive.events import Ended, Inbox
from executive.types import DriveTo, Failed, Goal, PutDown, Result, Succeeded
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
