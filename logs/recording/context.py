"""The context of a record for its messages: its time, and earlier records that matter."""

from dataclasses import dataclass
from datetime import datetime

from executive.records import Picture, Record, Transforms
from logs.recorder import Stamp
from logs.recording.foxglove import CAMERA_FRAME
from logs.recording.sound import in_mission


def nanoseconds(time: datetime) -> int:
    """Nanoseconds since 1970, exact to the microsecond."""
    return round(time.timestamp() * 1e6) * 1000


@dataclass(slots=True)
class Context:
    """The time of the record being written, and what matters of the records before it.

    `ns` is run start + mission time, as nanoseconds since 1970: the time base of a log.
    """

    origin_ns: int
    ns: int = 0
    stamp: Stamp = Stamp(0.0, 0)
    camera_frame_published: bool = False
    """Whether the robot itself publishes the frame of its camera."""
    _picture: tuple[int, int] = (-1, 0)

    def now(self, stamp: Stamp) -> None:
        """Set the time of the next record.

        Raises:
            ValueError: if no mission can have this time.
        """
        ns = self.origin_ns + round(in_mission(stamp.mission_s) * 1e9)
        if not 0 <= ns < 2**63:
            raise ValueError(f"a mission time of {stamp.mission_s} s")
        self.ns, self.stamp = ns, stamp

    def taken_ns(self, frame_number: int) -> int:
        """When the picture with this number was taken (ns); `ns`, if it is not the last one."""
        number, ns = self._picture
        return ns if number == frame_number else self.ns

    def remember(self, record: Record) -> None:
        """Note a record that was written, since later ones may refer to it."""
        match record:
            case Picture(frame):
                self._picture = (frame.number, self.ns)
            case Transforms(transforms):
                self.camera_frame_published |= any(t.child == CAMERA_FRAME for t in transforms)
            case _:
                pass
