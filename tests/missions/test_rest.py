"""At rest means base, arm, fingers and head; and what the hand holds is known, come what may."""

from collections.abc import Callable, Iterator
from threading import Event, Thread

import numpy as np
import pytest
from kitchen import Kitchen
from patience import PATIENCE_S

from executive.clock import SimulatedClock
from executive.events import Ended, StopRequested
from executive.types.goals import DriveTo, Halt, Pick, PutDown
from executive.types.results import Failed, Result, Succeeded
from sim.body.hardware import FINGER_TRAVEL
from sim.manipulation import manipulator

pytestmark = pytest.mark.physics

REST_S = 0.5


@pytest.fixture
def kitchen() -> Iterator[Kitchen]:
    kitchen = Kitchen()
    kitchen.do(DriveTo(kitchen.place))
    yield kitchen
    kitchen.world.close()


def until(kitchen: Kitchen, true: Callable[[], bool]) -> None:
    while not true():
        kitchen.world.advance(0.1)


def halt(kitchen: Kitchen) -> Result:
    """What comes of a Halt within half a second."""
    request = kitchen.robot.start(Halt())
    kitchen.wait(REST_S)
    ends = [e for e in kitchen.inbox.take_all() if isinstance(e, Ended)]
    (result,) = (end.result for end in ends if end.request == request)
    return result


def posture(kitchen: Kitchen) -> np.ndarray:
    hardware = kitchen.world._hardware
    parts = hardware.base_pose, hardware.arm_positions, hardware.head_positions, [hardware.gap]
    return np.concatenate(parts)


def believed(kitchen: Kitchen) -> str | None:
    held = kitchen.robot._manipulator.hand.held
    return held.model.name if held else None


def test_a_stop_at_any_moment_of_a_pick_leaves_the_robot_at_rest_and_sure_of_its_hand() -> None:
    kitchen = Kitchen()
    kitchen.do(DriveTo(kitchen.place))
    seen = kitchen.detection_of("sugar_box")
    for seconds in (0.5, 4.0, 6.5, 8.0):
        kitchen.robot.start(Pick(seen))
        kitchen.wait(seconds)
        assert halt(kitchen) == Succeeded()
        there = posture(kitchen)
        assert believed(kitchen) == kitchen.world.held
        assert kitchen.robot.holding == (kitchen.world.held is not None)
        kitchen.wait(1.0)
        assert np.abs(posture(kitchen) - there).max() < 5e-3
    kitchen.world.close()


def test_what_was_gripped_when_someone_said_stop_can_be_put_down(kitchen: Kitchen) -> None:
    kitchen.robot.start(Pick(kitchen.detection_of("sugar_box")))
    until(kitchen, lambda: kitchen.world.held == "sugar_box")
    assert halt(kitchen) == Succeeded()
    assert kitchen.robot.holding
    assert believed(kitchen) == "sugar_box"
    assert kitchen.do(PutDown(kitchen.place)) == Succeeded()
    assert kitchen.world.resting_place("sugar_box") == kitchen.place
    assert not kitchen.robot.holding


def test_fingers_that_close_when_someone_says_stop_hold_nothing(kitchen: Kitchen) -> None:
    hand, hardware = kitchen.robot._manipulator.hand, kitchen.world._hardware
    kitchen.robot.start(Pick(kitchen.detection_of("sugar_box")))
    until(kitchen, lambda: hardware.gap > FINGER_TRAVEL)
    hardware.squeeze(10.0)
    kitchen.wait(0.1)
    assert halt(kitchen) == Succeeded()
    assert hardware.gap > 0.01
    assert not hand.holding
    assert believed(kitchen) is None


def test_a_thing_that_is_let_go_when_someone_says_stop_is_let_go(kitchen: Kitchen) -> None:
    assert kitchen.do(Pick(kitchen.detection_of("sugar_box"))) == Succeeded()
    hand = kitchen.robot._manipulator.hand
    kitchen.robot.start(PutDown(kitchen.place))
    until(kitchen, lambda: hand._opened)
    assert halt(kitchen) == Succeeded()
    assert kitchen.world.held is None
    assert not kitchen.robot.holding
    assert believed(kitchen) is None


def test_a_robot_that_cannot_come_to_rest_says_what_moves(
    kitchen: Kitchen, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kitchen.world._hardware, "moving", lambda: ("arm", "head"))
    result = kitchen.do(Halt())
    assert result == Failed("I cannot come to rest: my arm and my head move")


def test_a_skill_that_raises_fails_in_words_and_leaves_the_robot_at_rest(
    kitchen: Kitchen, monkeypatch: pytest.MonkeyPatch
) -> None:
    def wrong(*args: object) -> object:
        raise ZeroDivisionError("no such pose")

    monkeypatch.setattr(manipulator, "fit_fallen_pose", wrong)
    result = kitchen.do(Pick(kitchen.detection_of("sugar_box")))
    assert result == Failed("something is wrong with my control: no such pose")
    kitchen.wait(REST_S)
    assert not kitchen.robot.moving()


def test_a_stop_is_heard_while_a_pose_is_fitted(
    kitchen: Kitchen, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, go_on, fit = Event(), Event(), manipulator.fit_fallen_pose

    def slowly(*args: object) -> object:
        begun.set()
        go_on.wait(PATIENCE_S)
        return fit(*args)  # type: ignore[arg-type]

    def stop() -> None:
        begun.wait(PATIENCE_S)
        kitchen.inbox.post(StopRequested("the person"))

    seen = kitchen.detection_of("sugar_box")
    monkeypatch.setattr(manipulator, "fit_fallen_pose", slowly)
    clock = SimulatedClock(kitchen.inbox, kitchen.world)
    request = kitchen.robot.start(Pick(seen))
    Thread(target=stop).start()
    clock.wait(None)
    assert not go_on.is_set()
    assert [type(event) for event in kitchen.inbox.take_all()] == [StopRequested]
    kitchen.robot.cancel(request)
    assert kitchen.do(Halt()) == Succeeded()
    go_on.set()
    assert kitchen.do(Pick(seen)) == Succeeded()
