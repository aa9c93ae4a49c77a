"""Travel times: from where the robot is, between places, and from halfway."""

from collections.abc import Sequence
from math import isfinite, sqrt

from executive.records import WaysTold
from executive.situation import Leg
from trees.context import MissionContext


class Ways:
    """Travel times as the robot estimates them; new estimates are recorded for the replay."""

    def __init__(self, context: MissionContext) -> None:
        """Nothing is known yet."""
        self._context = context
        self._told: dict[str, dict[str, float]] = {}

    def seconds(self, start: str, places: Sequence[str]) -> list[float]:
        """Time to drive from `start` to each place and to look at all of it (s)."""
        ways = self.driving(start, places)
        return [way + self._look_s(place) for way, place in zip(ways, places, strict=True)]

    def driving(self, start: str, places: Sequence[str]) -> list[float]:
        """Time to drive from `start` to each place (s); infinite if it cannot be reached."""
        told = self._told.setdefault(start, {})
        if new := tuple(place for place in places if place not in told):
            told |= {place: self._context.robot.seconds(start, place) for place in new}
            ways = tuple(told[p] if isfinite(told[p]) else -1.0 for p in new)
            self._context.recorder.record(WaysTold(start, new, ways))
        return [told[place] for place in places]

    def seconds_from_halfway(self, leg: Leg, places: Sequence[str]) -> list[float]:
        """The same from a position on a leg, as if ways were straight (Stewart's theorem)."""
        driven = self._context.clock.now() - leg.since_s if leg.driven_s is None else leg.driven_s
        whole, *_ = self.driving(leg.start, (leg.place,))
        part = min(1.0, driven / whole) if whole > 0 else 1.0
        ends = zip(self.driving(leg.start, places), self.driving(leg.place, places), strict=True)
        ways = (between(back, on, whole, part) for back, on in ends)
        return [way + self._look_s(place) for way, place in zip(ways, places, strict=True)]

    def _look_s(self, place: str) -> float:
        return self._context.parameters.look_s * self._context.robot.views(place)


def between(back: float, on: float, whole: float, part: float) -> float:
    """Distance (or time) from a position on a straight way to a point.

    Args:
        back: from the start of the way to the point.
        on: from the end of the way to the point.
        whole: length of the way, in the same unit.
        part: the travelled fraction of the way (0 to 1).
    """
    if not isfinite(back + on + whole):
        return max(back, on)
    return sqrt(max(0.0, (1 - part) * back**2 + part * on**2 - part * (1 - part) * whole**2))
