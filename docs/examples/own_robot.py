"""A robot of one's own: an adapter for a driver that blocks, and what `--world` is given.

    python docs/examples/own_robot.py

or, as any robot, in the folder of its file:

    python -m executive --world own_robot:build --llm none --user none Bring the hammer

`DriverRobot` is to be kept; docs/own-robot.md says what it has to heed, and why. The rest stands in
for hardware: `ToyDriver` drives nowhere, and knows in truth where three things are; `ToyEyes` sees
them as long as the driver says that it stands before them.
"""

import threading
from collections.abc import Collection
from concurrent.futures import ThreadPoolExecutor
from itertools import count
from math import inf
from typing import Protocol

import numpy as np

from executive import (
    DELIVERY,
    FLOOR,
    Box,
    Detection,
    DriveTo,
    Embodiment,
    Failed,
    Goal,
    Halt,
    Inbox,
    LookAt,
    Pick,
    PutDown,
    Saw,
    Session,
    Setup,
    Succeeded,
    load_settings,
)
from executive.clock import RealClock

# --- the adapter ---


class Driver(Protocol):
    """What your robot has already: calls that block until it is done."""

    @property
    def holding(self) -> bool:
        """Whether there is something in the hand."""

    def seconds(self, start: str, place: str) -> float:
        """How long that drive takes, as far as you can tell; infinite if there is no way."""

    def pursue(self, goal: Goal, called_off: threading.Event) -> str | None:
        """Returns when the goal is reached, or why not, and soon after `called_off` is set."""


class DriverRobot:
    """Implements `Robot`."""

    def __init__(self, driver: Driver, inbox: Inbox) -> None:
        """Have one worker keep goals in order."""
        self._driver = driver
        self._inbox = inbox
        self._worker = ThreadPoolExecutor(max_workers=1)
        self._request = 0
        self._called_off = threading.Event()

    @property
    def holding(self) -> bool:
        """As the driver says."""
        return self._driver.holding

    def views(self, place: str) -> int:
        """One look is enough for any place."""
        return 1

    def seconds(self, start: str, place: str) -> float:
        """As the driver says."""
        return self._driver.seconds(start, place)

    def start(self, goal: Goal) -> int:
        """Call off what is under way, and have the worker do this next."""
        self._called_off.set()
        self._called_off = threading.Event()
        self._request = self._inbox.open(real=True)
        self._worker.submit(self._pursue, self._request, goal, self._called_off)
        return self._request

    def cancel(self, request: int) -> None:
        """Its end is of no interest any more; an old one's number leaves the new one alone."""
        self._inbox.drop(request)
        if request == self._request:
            self._called_off.set()

    def _pursue(self, request: int, goal: Goal, called_off: threading.Event) -> None:
        try:
            reason = self._driver.pursue(goal, called_off)
        except Exception as error:
            reason = f"my driver fails: {error}"
        if called_off.is_set():
            reason = "replaced by another goal"
        self._inbox.end(request, Failed(reason) if reason else Succeeded())


# --- what stands in for hardware ---

TAKES_S = 0.02
"""How long the toy takes for anything."""


class ToyDriver:
    """Implements `Driver` without a robot: it waits a little, and keeps book."""

    def __init__(self, places: Collection[str]) -> None:
        """Stand beside the person, with an empty hand."""
        self._places = {*places, "person", DELIVERY}
        self._things = {
            "mug": "coffee_table",
            "hammer": "shelf_lobby",
            "sugar_box": "counter_wagon",
        }
        self._at = "person"
        self._held = ""

    @property
    def holding(self) -> bool:
        """By the book."""
        return bool(self._held)

    def in_view(self) -> list[str]:
        """What is where it stands."""
        return [name for name, place in self._things.items() if place == self._at]

    def seconds(self, start: str, place: str) -> float:
        """As long as anything."""
        return TAKES_S if {start, place} <= self._places else inf

    def pursue(self, goal: Goal, called_off: threading.Event) -> str | None:
        """Everything takes as long, and goes well if it can be."""
        called_off.wait(TAKES_S)
        match goal:
            case DriveTo(place) if place in self._places:
                self._at = place
            case LookAt(place, 0) if place in (self._at, FLOOR):
                pass
            case Pick(thing) if not self._held and thing.label in self.in_view():
                self._held = thing.label
                del self._things[thing.label]
            case PutDown(place) if self._held and place == self._at:
                self._things[self._held], self._held = place, ""
            case Halt():
                pass
            case _:
                return f"I cannot do that: {goal}"
        return None

    def close(self) -> None:
        """Nothing to let go of."""


class ToyEyes:
    """Implements `Perception` without a camera: sees what the driver knows to be there."""

    def __init__(self, driver: ToyDriver, inbox: Inbox) -> None:
        """See for this driver."""
        self._driver = driver
        self._inbox = inbox
        self._numbers = count()

    def see(self) -> int:
        """All that is there, without doubt, and at once."""
        request = self._inbox.open()
        box, mask = Box(0, 0, 8, 8), np.ones((8, 8), np.bool_)
        seen = tuple(Detection(name, 1.0, box, mask) for name in self._driver.in_view())
        self._inbox.end(request, Saw(next(self._numbers), seen))
        return request

    def cancel(self, request: int) -> None:
        """Forget it."""
        self._inbox.drop(request)


# --- what `--world own_robot:build` names ---


def build(setup: Setup) -> Embodiment:
    """The robot with its senses and its time; what is opened here is closed by `close`."""
    inbox = setup.inbox
    driver = ToyDriver([place.name for place in setup.home.places()])
    perception = ToyEyes(driver, inbox)
    return Embodiment(
        robot=DriverRobot(driver, inbox),
        perception=perception,
        clock=RealClock(inbox),
        in_map=False,  # these eyes do not tell where in `map` things are
        close=driver.close,
    )


if __name__ == "__main__":
    with Session(load_settings(world="own_robot:build", llm="none", user="none")) as session:
        print(session.run("Bring the hammer").reason)
