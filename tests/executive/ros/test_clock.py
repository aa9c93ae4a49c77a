"""Mission time by the robot's own clock, as far as a goal is under way."""

from typing import Any

from executive.events import Inbox
from executive.ros.clock import GoalTime


class Acts:
    """A robot that has been at goals so long (s)."""

    acted = 0.0

    def acted_s(self) -> float:
        return self.acted


def test_time_does_not_go_back_with_a_clock_that_begins_anew() -> None:
    robot: Any = Acts()
    time = GoalTime(Inbox(), robot)
    passed = []
    for robot.acted in (5.0, 0.5, 2.0):
        passed.append(time.passed())
    assert passed == [5.0, 0.0, 1.5]
