"""How a robot over the wire is stopped, whatever the wire does."""

import asyncio
import math
from collections import Counter
from typing import Any

import pytest

from executive.ros import stopping
from executive.ros.link import LinkError
from executive.ros.profile import load_profile
from executive.ros.stopping import Brake

DRIVE = "/navigate_to_pose"


class Robot:
    """A link to a robot that drives until it is told to stop, and what is sensed of it."""

    loss = ""

    def __init__(self) -> None:
        self.cancels: Counter[str] = Counter()
        self.deaf_to = 0.0
        """So many cancels of a drive come before it begins."""
        self.answers_only_at_rest: set[str] = set()
        self.pursues: list[str] = []
        """The ids of goals that are open when it is told to stop."""

    def greet_with(self, greeting: Any) -> None:
        self.greeting = greeting

    async def call(self, service: str, *_: Any, within_s: float, **__: Any) -> dict[str, Any]:
        action, hidden, _ = service.partition("/_action/cancel_goal")
        assert hidden
        self.cancels[action] += 1
        if action in self.answers_only_at_rest:
            await self._rest(within_s)
        open_goals, self.pursues = self.pursues, []
        return {"return_code": 0, "goals_canceling": open_goals}

    async def _rest(self, within_s: float) -> None:
        try:
            async with asyncio.timeout(within_s):
                while self.unrest:
                    await asyncio.sleep(0.01)
        except TimeoutError:
            raise LinkError("it does not answer") from None

    def feel_motion_anew(self, *, urgent: bool = False) -> None:
        pass

    @property
    def unrest(self) -> str:
        return "" if self.cancels[DRIVE] > self.deaf_to else "my base moves"


def stopped(robot: Any) -> tuple[dict[str, str], str]:
    async def stop() -> tuple[dict[str, str], str]:
        return await Brake(robot, load_profile("served"), robot).stop()

    return asyncio.run(stop())


def test_what_moves_on_is_cancelled_again() -> None:
    robot: Any = Robot()
    robot.deaf_to = 1
    assert stopped(robot) == ({}, "")
    assert robot.cancels[DRIVE] >= 2


def test_what_begins_after_it_was_cancelled_is_cancelled_before_all_is_answered() -> None:
    robot: Any = Robot()
    robot.deaf_to = 1
    robot.answers_only_at_rest.add("/pick")
    assert stopped(robot) == ({}, "")


def test_what_cannot_be_stopped_is_told_with_what_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stopping, "REST_S", 0.1)
    monkeypatch.setattr(stopping, "CANCELLING_S", 0.1)
    robot: Any = Robot()
    robot.deaf_to = math.inf
    robot.answers_only_at_rest.add("/pick")
    failures, unrest = stopped(robot)
    assert failures == {"pick": "it does not answer"}
    assert unrest == "my base moves"


def test_what_others_had_it_do_is_ended_and_told_once(caplog: pytest.LogCaptureFixture) -> None:
    robot: Any = Robot()
    Brake(robot, load_profile("served"), robot)
    for _ in range(2):  # the second time, what it was at was begun here
        robot.pursues = ["a goal"]
        asyncio.run(robot.greeting())
    assert caplog.messages == [stopping.DRIVEN]
