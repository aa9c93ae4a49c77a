"""What the missions record, as the page shows it: a log that keeps only the latest."""

import math
import threading
import time
from collections import OrderedDict
from functools import lru_cache
from typing import Any

from executive.events import Broke, Ended, Started, StopRequested
from executive.page.board import Board
from executive.page.doing import Doing
from executive.page.places import Places
from executive.records import (
    Activity,
    EventTaken,
    Finished,
    Picture,
    PlannedPath,
    Record,
    Seen,
    Tick,
    Transforms,
    TreeShape,
)
from executive.types.geometry import Pose
from executive.types.outcome import Outcome
from executive.types.perception import Frame
from executive.types.results import Answered
from logs.images import jpeg
from logs.recorder import Stamp

KEPT_FRAMES = 2
"""Of what was seen just now it is told a moment later what was recognised; and a page may still ask
for the picture before the latest that was shown."""
PICTURE_S = 1.0
"""So often are pictures shown that were taken on the way; a simulation may be faster."""
BASE = "base_link"


class PageSink:
    """Implements Sink: writes on the board. It outlives missions: to close it changes nothing."""

    live = True
    """Someone watches: it is flushed soon."""

    def __init__(self, board: Board) -> None:
        """Nothing is known of the robot yet."""
        self._board = board
        self._doing: Doing | None = None
        self._lock = threading.Lock()
        self._pictured_s = -PICTURE_S
        """When a picture was shown last that was taken on the way (s)."""
        self._frames: OrderedDict[int, Frame] = OrderedDict()
        self._shown: OrderedDict[int, Frame] = OrderedDict()
        """Pictures that pages were told of: whoever opens one later asks for the last of them."""
        self._jpeg = lru_cache(KEPT_FRAMES)(jpeg)
        self._pose: Pose | None = None
        self._places = Places()
        self._is_cut_short = False
        """Whether the mission was stopped, or broke: it does not tell the person how it ended."""
        board.put("doing", {"state": "starting"})

    def write(self, stamp: Stamp, record: Record) -> None:
        """Show it; the pages are told with the next flush."""
        match record:
            case EventTaken(event):
                self._take(event)
            case TreeShape():
                self._doing = Doing(record)
            case Tick():
                self._show_tick(record)
            case Transforms(transforms):
                self._pose = next(
                    (t.pose for t in transforms if t.child == BASE and t.parent == "map"),
                    self._pose,
                )
            case PlannedPath(points):
                self._board.put("path", [_rounded(x, y) for x, y, *_ in points])
            case Picture(frame) if frame.color.size:  # waited for here, not where it is served
                self._keep(frame)
            case Seen():
                self._show_seen(record)
            case Finished(outcome):
                self._finish(outcome)
            case _:
                pass

    def flush(self) -> None:
        """Tell the pages. Of all the ways that the robot went since the last time, they see one."""
        if self._pose is not None:
            self._board.put("robot", _planar(self._pose), waits=True)
        self._board.flush()

    def close(self) -> None:
        """The mission is over; the next one goes on here."""
        self.flush()

    def picture(self, number: int) -> bytes | None:
        """One of the pictures shown last, as JPEG; None if it is gone. For any thread.

        It is made for the first page that asks, and for none if none does.
        """
        with self._lock:
            frame = self._shown.get(number)
            return self._jpeg(frame) if frame is not None else None

    def _take(self, event: object) -> None:
        if isinstance(event, StopRequested | Broke):
            self._is_cut_short = True
        elif isinstance(event, Started):
            self._is_cut_short = False
            self._places = Places()
            self._board.put("outcome", None)
            self._board.put("places", None)
            self._board.put("path", [])
            self._board.put("doing", {"state": "busy", "words": event.words})
        elif isinstance(event, Ended) and isinstance(event.result, Answered):
            self._board.put("doing", {"state": "busy"})

    def _show_tick(self, tick: Tick) -> None:
        if self._doing:
            doing = self._doing.now(tick)
            self._board.put("doing", doing)
            self._board.put(
                "places", self._places.after(tick.situation, searching=doing["searching"])
            )
            if doing["activity"] != Activity.DRIVING:
                self._board.put("path", [])

    def _keep(self, frame: Frame) -> None:
        _add(self._frames, frame)
        if (now := time.monotonic()) - self._pictured_s >= PICTURE_S:
            self._pictured_s = now
            self._show_picture(frame, None)

    def _show_seen(self, seen: Seen) -> None:
        frame = self._frames.get(seen.frame_number)
        if frame is not None:
            boxes = [
                {
                    "label": d.label,
                    "confidence": round(float(d.confidence), 2),
                    "box": [d.box.left, d.box.top, d.box.width, d.box.height],
                }
                for d in seen.detections
            ]
            self._show_picture(frame, boxes)

    def _show_picture(self, frame: Frame, boxes: list[dict[str, Any]] | None) -> None:
        with self._lock:
            _add(self._shown, frame)
        height, width, _ = frame.color.shape
        shown = {"number": frame.number, "width": width, "height": height, "seen": boxes}
        self._board.put("camera", shown, waits=boxes is None)

    def _finish(self, outcome: Outcome) -> None:
        self._board.put("doing", {"state": "rest"})
        self._board.put("path", [])
        self._board.put("places", self._places.at_the_end())
        untold = outcome.reason.rstrip(".") if self._is_cut_short else ""
        self._board.put("outcome", {"status": outcome.status, "untold": untold})


def _add(kept: OrderedDict[int, Frame], frame: Frame) -> None:
    """Keep it as the latest, and only so many."""
    kept[frame.number] = frame
    kept.move_to_end(frame.number)
    while len(kept) > KEPT_FRAMES:
        kept.popitem(last=False)


def _rounded(*numbers: float) -> list[float]:
    """Centimetres are enough to draw."""
    return [round(number, 2) for number in numbers]


def _planar(pose: Pose) -> list[float]:
    x, y, _ = pose.position
    qx, qy, qz, qw = pose.orientation
    yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
    return [*_rounded(x, y), round(yaw, 3)]
