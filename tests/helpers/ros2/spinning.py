"""How a node of the tests goes on, whoever comes and goes."""

from contextlib import suppress
from typing import Any


def spin(executor: Any) -> None:
    """Until it is shut down.

    A client that is not found yet, or is gone, when it is to be answered, ends what rclpy is at.
    """
    while True:
        with suppress(SystemError):
            executor.spin()
            return
