"""How long ways take: from where the robot is, between places, and from halfway."""

from collections.abc import Sequence
from math import isfinite, sqrt

from executive.records import WaysTold
from executive.situation import Leg
from trees.context import MissionContext


class Ways:
    """How long ways take, as the robot told; what was asked anew is recorded, for a replay."""

    def __init__(self, context: MissionContext) -> None:
        """Ask nothing yet."""
        self._context = context
        self._told: dict[str, dict[str, float]] = {}

    def seconds(self, start: str, places: Sequence[str]) -> list[float]:
        """Of the ways from here, and of looking at all of each place (s)."""
        ways = self.driving(start, places)
        return [way + self._look_s(place) for way, place in zip(ways, places, strict=True)]

    def driving(self, start: str, places: Sequence[str]) -> list[float]:
        """Of the ways alone (s)."""
        told = self._told.setdefault(start, {})
        if new := tuple(place for place in places if place not in told):
            told |= {place: self._context.robot.seconds(start, place) for place in new}
            ways = tuple(told[p] if isfinite(told[p]) else -1.0 for p in new)
            self._context.recorder.record(WaysTold(start, new, ways))
        return [told[place] for place in places]

    def seconds_from_halfway(self, leg: Leg, places: Sequence[str]) -> list[float]:
        """The same from between two places, as if ways were straight (Stewart's theorem)."""
        driven = self._context.clock.now() - leg.since_s if leg.driven_s is None else leg.driven_s
        whole, *_ = self.driving(leg.start, (leg.place,))
        part = min(1.0, driven / whole) if whole > 0 else 1.0
        ends = zip(self.driving(leg.start, places), self.driving(leg.place, places), strict=True)
        ways = (between(back, on, whole, part) for back, on in ends)
        return [way + self._look_s(place) for way, place in zip(ways, places, strict=True)]

    def _look_s(self, place: str) -> float:
        return self._context.parameters.look_s * self._context.robot.views(place)


def between(back: float, on: float, whole: float, part: float) -> float:
    """How far it is from a part (0 to 1) of a straight way to a point.

    Args:
        back: how far it is from the beginning of the way.
        on: how far it is from its end.
        whole: how long the way is.
        part: how much of it is behind.
    """
    if not isfinite(back + on + whole):
        return max(back, on)
    return sqrt(max(0.0, (1 - part) * back**2 + part * on**2 - part * (1 - part) * whole**2))
