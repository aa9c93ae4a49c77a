"""The robot's body."""

from typing import Protocol

from executive.types.goals import Goal


class Robot(Protocol):
    """A mobile manipulator that pursues one goal at a time.

    Starting a goal while another is under way replaces it: the earlier request ends as Failed.
    """

    def start(self, goal: Goal) -> int:
        """Pursue a goal; ends Succeeded, or Failed with a reason that a person understands."""
        ...

    def cancel(self, request: int) -> None:
        """Give up the goal and brake to rest; its end is not delivered."""
        ...

    def views(self, place: str) -> int:
        """How many head poses it takes to see all of a place or of the `floor` (at least 1)."""
        ...

    def seconds(self, start: str, place: str) -> float:
        """How long it takes to drive from one place to another one, `person` and `delivery` too.

        As far as is known before it is tried, within 15 % (and half a second) of what the drive
        then takes; infinite if there is no way, or no such place. It is asked on the ticking
        thread, for all pairs of places: an answer takes microseconds, once it is known.
        """
        ...

    @property
    def holding(self) -> bool | None:
        """Whether both fingers touch a thing; None if the robot cannot tell.

        It is asked when the robot has nothing to do, and is what the robot believes of its hand.
        """
        ...
