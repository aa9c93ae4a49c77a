"""From camera frames to objects located in `map`."""

import logging
import traceback
from dataclasses import replace
from functools import partial

import cv2
import numpy as np

from executive.computing import Computation, Worker
from executive.errors import UnreachableError
from executive.events import Inbox
from executive.geometry import back_project
from executive.interfaces.perception import Camera, Detector
from executive.interfaces.runtime import Recorder
from executive.records import Note, Picture, Seen
from executive.text import printable
from executive.types.perception import Box, Detection, Frame
from executive.types.results import Failed, Saw

log = logging.getLogger(__name__)

_EDGE_PIXELS = 3
"""A detection this near to the edge of the picture may continue outside."""


class CameraPerception:
    """Implements `Perception`: takes a picture, detects objects, and locates them by depth.

    The picture is taken within `see`; with a `far` camera, in a computation. Detection, and waiting
    for pixels that are still being rendered, are computations, too. Mission time stands still
    during a computation.
    """

    def __init__(
        self,
        camera: Camera,
        detector: Detector,
        inbox: Inbox,
        recorder: Recorder,
        far: bool = False,
    ) -> None:
        """Join camera and detector; `far` if taking a picture is slow, as over a network."""
        self._far = far
        self._camera = camera
        self._detector = detector
        self._inbox = inbox
        self._recorder = recorder
        self._worker = Worker("eyes")

    def see(self) -> int:
        """Take a picture and detect; ends Saw, or Failed if either fails or all is black."""
        request = self._inbox.open()
        if self._far:
            take = partial(self._take, request)
            self._inbox.compute(self._worker, self._camera.capture, take, request)
            return request
        try:
            frame = self._camera.capture()
        except Exception as error:
            self._fail(request, "my camera failed", error)
            return request
        self._recorder.record(Picture(frame))
        if frame.coming:
            come = partial(self._come, request, frame)
            self._inbox.compute(self._worker, lambda: frame.color, come, request)
        else:
            self._look_at(request, frame)
        return request

    def _come(self, request: int, frame: Frame, pixels: Computation[object]) -> None:
        """The pixels of a picture have come; if that failed, take another one at once."""
        try:
            pixels.result()
        except Exception as error:
            log.debug("a picture did not come", exc_info=error)
            try:
                frame = self._camera.capture()
            except Exception as again:
                self._fail(request, "my camera failed", again)
                return
            self._recorder.record(Picture(frame))
        self._look_at(request, frame)

    def _take(self, request: int, computation: Computation[Frame]) -> None:
        """A picture of a `far` camera has come."""
        try:
            frame = computation.result()
        except Exception as error:
            self._fail(request, "my camera failed", error)
            return
        self._recorder.record(Picture(frame))
        self._look_at(request, frame)

    def _look_at(self, request: int, frame: Frame) -> None:
        if not frame.color.any():
            self._inbox.end(request, Failed("my camera shows nothing"))
            return
        say = partial(self._say, request, frame.number)
        self._inbox.compute(self._worker, partial(self._recognise, frame), say, request)

    def cancel(self, request: int) -> None:
        """Cancel the request; its result is not delivered."""
        self._inbox.drop(request)

    def _recognise(self, frame: Frame) -> tuple[Detection, ...]:
        return tuple(locate(d, frame) for d in self._detector.detect(frame))

    def _say(
        self, request: int, number: int, computation: Computation[tuple[Detection, ...]]
    ) -> None:
        try:
            found = computation.result()
        except Exception as error:
            self._fail(request, "my eyes failed", error)
            return
        self._recorder.record(Seen(number, found))
        self._inbox.end(request, Saw(number, found))

    def _fail(self, request: int, what: str, error: Exception) -> None:
        log.debug(what, exc_info=error)
        self._recorder.record(Note("error", "".join(traceback.format_exception(error))))
        why = printable(f"{what}: {error}" if str(error) else f"{what}: {type(error).__name__}")
        self._inbox.end(request, Failed(why, unreachable=isinstance(error, UnreachableError)))


def locate(detection: Detection, frame: Frame) -> Detection:
    """Add the visible surface in `map` to a detection.

    Pixels at the edge of the mask mix the thing with the background, so the mask is eroded by one
    pixel if enough is left.
    """
    box = detection.box
    mask = detection.mask
    inner = cv2.erode(mask.astype(np.uint8), np.ones((3, 3), np.uint8), borderValue=0).astype(bool)
    if inner.sum() >= 30:
        mask = inner
    rows, columns = np.nonzero(mask)
    points = back_project(frame, rows + box.top, columns + box.left)
    return replace(detection, points=points, cut_off=_touches_edge(box, frame))


def _touches_edge(box: Box, frame: Frame) -> bool:
    lens = frame.intrinsics
    right, bottom = box.left + box.width, box.top + box.height
    nearest = min(box.left, box.top, lens.width - right, lens.height - bottom)
    return nearest < _EDGE_PIXELS
