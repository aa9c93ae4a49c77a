"""Times on the timelines of the rerun recording."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, NamedTuple, TypeVar

import numpy as np
import rerun as rr

MISSION_TIME, WALL_TIME, TICK = "mission_time", "wall_time", "tick"
"""Names of the timelines."""

T = TypeVar("T")


class Moment(NamedTuple):
    """Mission time (ns), wall time (ns since 1970) and number of the last tick."""

    mission_ns: int
    wall_ns: int
    tick: int

    def set_on(self, stream: rr.RecordingStream) -> None:
        """Set the time of everything logged next."""
        stream.set_time(MISSION_TIME, duration=np.timedelta64(self.mission_ns, "ns"))
        stream.set_time(WALL_TIME, timestamp=np.datetime64(self.wall_ns, "ns"))
        stream.set_time(TICK, sequence=self.tick)


@dataclass(frozen=True, slots=True)
class At(Generic[T]):
    """A value and its time."""

    moment: Moment
    value: T


def time_columns(moments: Sequence[Moment]) -> list[rr.TimeColumn]:
    """The time columns of rows that are sent together."""
    mission_ns, wall_ns, ticks = np.array(moments, np.int64).T
    return [
        rr.TimeColumn(MISSION_TIME, duration=mission_ns.view("timedelta64[ns]")),
        rr.TimeColumn(WALL_TIME, timestamp=wall_ns.view("datetime64[ns]")),
        rr.TimeColumn(TICK, sequence=ticks),
    ]
