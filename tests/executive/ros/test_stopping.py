"""How a robot over the wire is stopped, whatever the wire does."""

import asyncio
from typing import Any

from executive.ros.profile import load_profile
from executive.ros.stopping import Brake


class Robot:
    """A link to a robot that moves until it is told to stop, and what is sensed of it."""

    loss = ""

    def __init__(self) -> None:
        self.cancels = 0

    def greet_with(self, greeting: Any) -> None:
        pass

    async def call(self, service: str, *_: Any, **__: Any) -> dict[str, Any]:
        self.cancels += service.endswith("/cancel_goal")
        return {"return_code": 0}

    def feel_motion_anew(self) -> None:
        pass

    @property
    def unrest(self) -> str:
        return "" if self.cancels else "my base moves"


def test_what_moves_on_is_cancelled_again() -> None:
    robot: Any = Robot()
    brake = Brake(robot, load_profile("served"), robot)
    assert asyncio.run(brake.rest()) == ""
    assert robot.cancels
