"""What a camera sees, and what is recognised in it."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from executive.types.geometry import Pose, Vector3

if TYPE_CHECKING:  # a quarter of the time that --help takes
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """A pinhole camera without distortion (pixels)."""

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float

    def scaled(self, factor: float) -> "Intrinsics":
        """The same camera with so many times as many pixels in a row."""
        width, height = round(self.width * factor), round(self.height * factor)
        return Intrinsics(
            width, height, self.fx * factor, self.fy * factor, self.cx * factor, self.cy * factor
        )


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One picture: colour, depth, and where the camera was.

    Attributes:
        number: counts the pictures of one robot from 0.
        color: (height, width, 3) uint8, RGB.
        depth: (height, width) float32, metres along the optical axis; infinite where nothing is.
        intrinsics: the camera's.
        pose: `camera_optical` in `map`.
    """

    number: int
    color: "NDArray[np.uint8]"
    depth: "NDArray[np.float32]"
    intrinsics: Intrinsics
    pose: Pose

    @property
    def coming(self) -> bool:
        """Whether its pixels are still drawn elsewhere: who reads them waits for them."""
        return False


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle in an image (pixels, from the top left corner)."""

    left: int
    top: int
    width: int
    height: int


def _no_points() -> "NDArray[np.float32]":
    import numpy as np

    return np.empty((0, 3), dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Detection:
    """A thing recognised in a picture.

    Attributes:
        label: an object's name as in the ontology.
        confidence: in [0, 1].
        box: in the picture.
        mask: (box.height, box.width) bool, the thing's pixels inside the box.
        points: (n, 3) float32, its visible surface in `map` (metres); empty until located by depth.
        cut_off: whether it reaches the edge of the picture, so that there may be more of it.
    """

    label: str
    confidence: float
    box: Box
    mask: "NDArray[np.bool_]"
    points: "NDArray[np.float32]" = field(default_factory=_no_points)
    cut_off: bool = False

    @property
    def position(self) -> Vector3 | None:
        """Middle of the visible surface in `map` (metres), or None before it is located."""
        if not len(self.points):
            return None
        from numpy import median

        x, y, z = (float(v) for v in median(self.points, axis=0))
        return x, y, z
