"""A picture that another process draws: its pixels come later than it is taken."""

from collections.abc import Callable
from concurrent.futures import Future
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from executive.types.geometry import Pose
from executive.types.perception import Frame, Intrinsics

if TYPE_CHECKING:  # the renderer takes long to import, and not all who get pictures have one
    from sim.pictures.painter import Pixels


class NotDrawnError(RuntimeError):
    """A picture that was asked for will never be there.

    It is no OSError: a log that cannot have the picture is sound all the same.
    """


class ComingFrame(Frame):
    """A Frame whose pixels are still drawn; who reads them waits for them.

    Reading them raises what the drawing raised.
    """

    __slots__ = ("_pixels",)
    _pixels: "Future[Pixels]"

    def __init__(
        self, number: int, intrinsics: Intrinsics, pose: Pose, pixels: "Future[Pixels]"
    ) -> None:
        """All is known but the pixels."""
        known = {"number": number, "intrinsics": intrinsics, "pose": pose, "_pixels": pixels}
        for name, value in known.items():
            object.__setattr__(self, name, value)  # frames are frozen

    @property
    def coming(self) -> bool:
        """It is taken as such when it has come, too: what follows is the same."""
        return True

    @property
    def is_drawn(self) -> bool:
        """Whether nobody has to wait for its pixels, or they will never be there."""
        return self._pixels.done()

    def when_drawn(self, then: Callable[[], None]) -> None:
        """Call this when it is, on whichever thread."""
        self._pixels.add_done_callback(lambda _: then())

    @property
    def color(self) -> NDArray[np.uint8]:
        """As any frame's."""
        return self._pixels.result()[0]

    @property
    def depth(self) -> NDArray[np.float32]:
        """As any frame's."""
        return self._pixels.result()[1]
