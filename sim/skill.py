"""What every skill of the robot is made of.

A skill is a generator that commands the motors and yields once per control period; the world lets
physics pass in between. It ends by returning, or raises CannotError.
"""

from collections.abc import Callable, Generator

Skill = Generator[None, None, None]

CONTROL_S = 1 / 60
"""Control period (seconds)."""


class CannotError(Exception):
    """The skill gave up; the message is a clause for the person: "the way is blocked"."""


def wait_until(true: Callable[[], bool], at_most: float) -> Generator[None, None, bool]:
    """Yield until the condition holds or the time (seconds) is up; return whether it held."""
    for _ in range(round(at_most / CONTROL_S)):
        if true():
            return True
        yield
    return true()


def pause(seconds: float) -> Skill:
    """Let some time pass."""
    for _ in range(round(seconds / CONTROL_S)):
        yield


def attempt(skill: Skill) -> Generator[None, None, CannotError | None]:
    """Run a skill; return its failure, if any, so that the robot can tidy up before it reports."""
    try:
        yield from skill
    except CannotError as failure:
        return failure
    return None
