"""The contract of every Robot. An adapter's tests subclass `RobotContract`.

Provide a fixture `bench` that yields a fresh `Bench`: the robot at rest beside the person, with an
empty hand, an inbox, and a way to let time pass.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
import pytest

from executive.events import Ended, Inbox
from executive.interfaces.robot import Robot
from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
from executive.types.home import FLOOR
from executive.types.perception import Box, Detection
from executive.types.results import Failed, Result, Succeeded

PATIENCE_S = 90.0
MOVING_S = 0.4
"""After this time (s), a started motion is visible."""
TELLING, TELLING_S = 0.15, 0.5
"""The tolerance of estimated durations of drives: this share, plus this many seconds."""
REST_S = 0.6
"""After this time (s), half a second and a margin, a robot is at rest after a halt or a cancel."""


@dataclass
class Bench:
    """A robot, its inbox, and a function that advances time.

    `advance` takes how many seconds to advance at most, and returns how many have passed.
    """

    robot: Robot
    inbox: Inbox
    advance: Callable[[float], float]
    place: str = "coffee_table"
    """A place of the home for the tests."""
    bare: str = "desk"
    """A place of the home without a mug."""
    moving: Callable[[], Sequence[str]] = tuple
    """Returns the parts of the robot that are moving, if that can be measured."""

    def end_of(self, request: int) -> Result:
        """Advance time until this request ends; return its result. Other events are dropped."""
        return self.timed_end_of(request)[0]

    def timed_end_of(self, request: int) -> tuple[Result, float]:
        """The same, with the time that it took (s)."""
        passed = 0.0
        while passed < PATIENCE_S:
            for event in self.inbox.take_all():
                if isinstance(event, Ended) and event.request == request:
                    return event.result, passed
            passed += self.advance(PATIENCE_S - passed)
        raise AssertionError(f"no end within {PATIENCE_S} s")

    def wait(self, seconds: float) -> None:
        """Advance time by at least these seconds."""
        passed = 0.0
        while passed < seconds:
            passed += self.advance(seconds - passed) or 0.01

    def do(self, goal: Goal) -> Result:
        """Pursue a goal until it ends; return the result."""
        return self.end_of(self.robot.start(goal))


def nothing_there() -> Detection:
    """A detection of a mug in mid-air, out of reach."""
    points = np.tile(np.array([[100.0, 100.0, 1.0]], np.float32), (50, 1))
    return Detection("mug", 1.0, Box(0, 0, 5, 10), np.ones((10, 5), np.bool_), points)


class RobotContract:
    """Each method tests one requirement of `Robot`."""

    def test_starting_returns_at_once_and_the_end_comes_as_an_event(self, bench: Bench) -> None:
        request = bench.robot.start(DriveTo(bench.place))
        assert not bench.inbox.has_events
        assert bench.end_of(request) == Succeeded()

    def test_it_drives_back_to_the_person(self, bench: Bench) -> None:
        assert bench.do(DriveTo(bench.place)) == Succeeded()
        assert bench.do(DriveTo("person")) == Succeeded()

    def test_it_knows_beforehand_how_long_a_drive_takes(self, bench: Bench) -> None:
        bench.do(DriveTo(bench.place))
        expected_s = bench.robot.seconds(bench.place, bench.bare)
        result, took_s = bench.timed_end_of(bench.robot.start(DriveTo(bench.bare)))
        assert result == Succeeded()
        assert abs(expected_s - took_s) <= TELLING * took_s + TELLING_S

    def test_there_is_no_way_to_an_unknown_place(self, bench: Bench) -> None:
        assert bench.robot.seconds("person", "atlantis") == inf
        assert bench.robot.seconds("atlantis", "person") == inf

    def test_every_request_has_its_own_number(self, bench: Bench) -> None:
        first = bench.robot.start(Halt())
        bench.end_of(first)
        assert bench.robot.start(Halt()) != first

    def test_an_unknown_place_fails_in_words(self, bench: Bench) -> None:
        result = bench.do(DriveTo("atlantis"))
        assert isinstance(result, Failed)
        assert "atlantis" in result.reason

    def test_a_second_goal_replaces_the_first_which_fails(self, bench: Bench) -> None:
        first = bench.robot.start(DriveTo(bench.place))
        second = bench.robot.start(Halt())
        ends: dict[int, Result] = {}
        while second not in ends:
            ends |= {e.request: e.result for e in bench.inbox.take_all() if isinstance(e, Ended)}
            bench.advance(1.0)
        assert isinstance(ends[first], Failed)
        assert ends[second] == Succeeded()

    def test_the_end_of_a_cancelled_goal_is_not_delivered(self, bench: Bench) -> None:
        request = bench.robot.start(DriveTo(bench.place))
        bench.robot.cancel(request)
        assert not bench.inbox.is_open(request)
        bench.advance(1.0)
        assert bench.do(Halt()) == Succeeded()
        assert not bench.inbox.awaits_anything

    @pytest.mark.parametrize("head", [False, True])
    def test_a_halt_succeeds_when_nothing_moves_any_more(self, bench: Bench, head: bool) -> None:
        bench.robot.start(LookAt(FLOOR, 1) if head else DriveTo(bench.place))
        bench.wait(MOVING_S)
        request = bench.robot.start(Halt())
        bench.wait(REST_S)
        ends = [e for e in bench.inbox.take_all() if isinstance(e, Ended) and e.request == request]
        assert [end.result for end in ends] == [Succeeded()]
        assert not bench.moving()

    @pytest.mark.parametrize("head", [False, True])
    def test_a_cancelled_goal_leaves_nothing_that_moves(self, bench: Bench, head: bool) -> None:
        request = bench.robot.start(LookAt(FLOOR, 1) if head else DriveTo(bench.place))
        bench.wait(MOVING_S)
        bench.robot.cancel(request)
        bench.wait(REST_S)
        assert not bench.moving()

    def test_after_a_cancelled_goal_it_drives_on(self, bench: Bench) -> None:
        bench.robot.cancel(bench.robot.start(DriveTo(bench.place)))
        assert bench.do(DriveTo(bench.place)) == Succeeded()

    def test_it_looks_at_every_view_of_the_place_that_it_is_at(self, bench: Bench) -> None:
        bench.do(DriveTo(bench.place))
        views = range(bench.robot.views(bench.place))
        assert len(views) >= 1
        assert all(bench.do(LookAt(bench.place, view)) == Succeeded() for view in views)

    def test_it_does_not_pretend_to_look_at_a_place_that_it_is_not_at(self, bench: Bench) -> None:
        assert isinstance(bench.do(LookAt(bench.place)), Failed)

    def test_it_looks_at_the_floor_wherever_it_is(self, bench: Bench) -> None:
        views = range(bench.robot.views(FLOOR))
        assert len(views) >= 1
        assert all(bench.do(LookAt(FLOOR, view)) == Succeeded() for view in views)

    def test_time_that_runs_out_is_a_cancel_and_leaves_the_robot_free(self, bench: Bench) -> None:
        request = bench.robot.start(DriveTo(bench.place))
        passed = 0.0
        while passed < 0.1:
            passed += bench.advance(0.1 - passed)
        bench.robot.cancel(request)
        assert bench.do(DriveTo("person")) == Succeeded()
        assert not bench.inbox.awaits_anything

    def test_cancelling_what_has_ended_or_never_was_does_nothing(self, bench: Bench) -> None:
        request = bench.robot.start(DriveTo(bench.place))
        assert bench.end_of(request) == Succeeded()
        bench.robot.cancel(request)
        bench.robot.cancel(request + 1000)
        assert bench.do(LookAt(bench.place)) == Succeeded()

    def test_cancelling_an_old_goal_leaves_the_new_one_alone(self, bench: Bench) -> None:
        first = bench.robot.start(Halt())
        bench.end_of(first)
        second = bench.robot.start(DriveTo(bench.place))
        bench.robot.cancel(first)
        assert bench.end_of(second) == Succeeded()

    def test_every_goal_ends_once(self, bench: Bench) -> None:
        requests = [bench.robot.start(DriveTo(bench.place)), bench.robot.start(Halt())]
        ends: list[int] = []
        passed = 0.0
        while bench.inbox.awaits_anything and passed < PATIENCE_S:
            ends += [e.request for e in bench.inbox.take_all() if isinstance(e, Ended)]
            passed += bench.advance(0.5)
        assert sorted(ends) == requests

    def test_a_view_that_is_not_there_fails_in_words(self, bench: Bench) -> None:
        bench.do(DriveTo(bench.place))
        result = bench.do(LookAt(bench.place, bench.robot.views(bench.place)))
        assert isinstance(result, Failed)
        assert result.reason

    def test_it_does_not_pretend_to_pick_what_is_not_there(self, bench: Bench) -> None:
        bench.do(DriveTo(bench.bare))
        assert isinstance(bench.do(Pick(nothing_there())), Failed)
        assert not bench.robot.holding

    def test_it_does_not_pretend_to_put_down_what_it_does_not_hold(self, bench: Bench) -> None:
        bench.do(DriveTo(bench.place))
        assert isinstance(bench.do(PutDown(bench.place)), Failed)
