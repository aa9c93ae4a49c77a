"""The robot's body."""

from typing import Protocol

from executive.types.goals import Goal


class Robot(Protocol):
    """A mobile manipulator that pursues one goal at a time.

    Starting a goal while another is active replaces it: the earlier request ends as Failed.
    """

    def start(self, goal: Goal) -> int:
        """Start to pursue a goal; ends Succeeded, or Failed with a reason for the person."""
        ...

    def cancel(self, request: int) -> None:
        """Abort the goal and brake to a standstill; its result is not delivered."""
        ...

    def views(self, place: str) -> int:
        """Number of head poses that together see all of a place or of the `floor` (at least 1)."""
        ...

    def seconds(self, start: str, place: str) -> float:
        """Estimated duration (s) of a drive between two places, `person` and `delivery` included.

        The real duration should be within 15 % (plus half a second) of it, unless something
        unknown is in the way. Infinite if there is no path, or no such place. Called on the ticking
        thread for all pairs of places: a repeated call must return within microseconds.
        """
        ...

    @property
    def holding(self) -> bool | None:
        """Whether both fingers touch an object; None if the robot cannot tell.

        Read while the robot is idle; the executive trusts it about what is in the hand.
        """
        ...
