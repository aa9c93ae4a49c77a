"""A frame that another process draws: its pixels arrive after the frame was taken."""

from collections.abc import Callable
from concurrent.futures import Future
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from executive.types.geometry import Pose
from executive.types.perception import Frame, Intrinsics

if TYPE_CHECKING:  # the renderer takes long to import, and not all users of frames need it
    from sim.pictures.painter import Pixels


class NotDrawnError(RuntimeError):
    """A requested picture will never arrive.

    It is no OSError, because that would mean that the log cannot be written.
    """


class ComingFrame(Frame):
    """A Frame whose pixels may still be missing; reading them waits until they are drawn.

    Reading them raises the exception of the drawing, if it failed.
    """

    __slots__ = ("_pixels",)
    _pixels: "Future[Pixels]"

    def __init__(
        self, number: int, intrinsics: Intrinsics, pose: Pose, pixels: "Future[Pixels]"
    ) -> None:
        """Make a frame of which only the pixels are missing."""
        known = {"number": number, "intrinsics": intrinsics, "pose": pose, "_pixels": pixels}
        for name, value in known.items():
            object.__setattr__(self, name, value)  # frames are frozen

    @property
    def coming(self) -> bool:
        """True even when the pixels are there, so that what follows does not depend on timing."""
        return True

    @property
    def is_drawn(self) -> bool:
        """Whether the pixels have arrived, or the drawing has failed."""
        return self._pixels.done()

    def when_drawn(self, then: Callable[[], None]) -> None:
        """Call `then` when `is_drawn` becomes true, on any thread; at once if it is true."""
        self._pixels.add_done_callback(lambda _: then())

    @property
    def color(self) -> NDArray[np.uint8]:
        """As in `Frame`; waits."""
        return self._pixels.result()[0]

    @property
    def depth(self) -> NDArray[np.float32]:
        """As in `Frame`; waits."""
        return self._pixels.result()[1]
