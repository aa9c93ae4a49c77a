"""Measures a mission from its records, for figures that are not in its outcome."""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

from executive.records import (
    Activity,
    LlmCall,
    Planned,
    Record,
    Tick,
    Transforms,
    TreeShape,
    Verified,
)
from executive.types.results import Replied, Scored
from logs.recorder import Stamp
from sim.navigation.grid import Point


@dataclass
class Observed:
    """A sink that computes figures from records."""

    calls: list[Replied | Scored] = field(default_factory=list)
    """Finished calls of the language model."""
    names: list[str] = field(default_factory=list)
    """Names of places in its replies."""
    unreached: int = 0
    """Number of places that the robot could not reach."""
    seconds: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))
    """Mission time (s) by activity, as the behaviours declare it."""
    searching_s: float = 0.0
    """Mission time (s) of driving to places and looking there, as the behaviours declare."""
    planned: Planned | None = None
    """The last plan before the first look."""
    positions: list[Point] = field(default_factory=list)
    """Positions of the robot's base in `map` (metres)."""
    _activities: dict[str, str] = field(default_factory=dict)
    _doing: str = ""
    _searches: bool = False
    _has_looked: bool = False
    _since_s: float = 0.0

    def write(self, stamp: Stamp, record: Record) -> None:
        """Take in a record."""
        match record:
            case LlmCall(result):
                self.calls.append(result)
            case Verified(_, accepted, rooms, dropped):
                self.names += [*accepted, *rooms, *dropped]
            case Planned() if not self._has_looked:
                self.planned = record
            case TreeShape(nodes):
                self._activities = {n.path: n.activity for n in nodes if n.activity}
            case Tick():
                self._take_time(stamp.mission_s, record)
                self.unreached = len(record.situation["unreached"])
                self._has_looked |= bool(record.situation["visited"])
            case Transforms(transforms):
                self.positions += [
                    t.pose.position[:2] for t in transforms if t.child == "base_link"
                ]
            case _:
                pass

    def flush(self) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""

    def exchanges(self) -> tuple[tuple[str, str], ...]:
        """Request and reply of each chat call about places."""
        return tuple(
            (call.request.messages[-1].content, call.text)
            for call in self.calls
            if isinstance(call, Replied) and call.request.label != "command"
        )

    def believed(self, place: str | None) -> tuple[float, float, int]:
        """The belief before the first look; (0, 0, 1) without a plan or a place.

        Returns:
            Probability of the likeliest place, probability of this place, and the number of places
            as likely as the likeliest.
        """
        told = self.planned
        if told is None or not told.places or place is None:
            return 0.0, 0.0, 1
        likely = dict(zip(told.places, told.probabilities, strict=True))
        most = max(likely.values())
        return most, likely.get(place, 0.0), list(likely.values()).count(most)

    def path_m(self, leg_m: Callable[[Point, Point], float]) -> float:
        """Length of the robot's path (metres); `leg_m` gives the length between two positions."""
        return sum(leg_m(a, b) for a, b in pairwise(self.positions))

    def _take_time(self, now_s: float, tick: Tick) -> None:
        """Add the time since the last tick to what was running then; the innermost counts."""
        self.seconds[self._doing] += now_s - self._since_s
        running = (n.path for n in reversed(tick.nodes) if n.status == "RUNNING")
        doing = [a for path in running if (a := self._activities.get(path))]
        if self._searches:
            self.searching_s += now_s - self._since_s
        self._doing = doing[0] if doing else ""
        self._searches = Activity.SEARCHING in doing
        self._since_s = now_s
