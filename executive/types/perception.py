"""Camera frames, and the things recognised in them."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from executive.types.geometry import Pose, Vector3

if TYPE_CHECKING:  # importing numpy takes a quarter of the time of --help
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """Intrinsics of a pinhole camera without distortion (pixels)."""

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float

    def scaled(self, factor: float) -> "Intrinsics":
        """The same camera with its width and height, in pixels, multiplied by `factor`."""
        width, height = round(self.width * factor), round(self.height * factor)
        return Intrinsics(
            width, height, self.fx * factor, self.fy * factor, self.cx * factor, self.cy * factor
        )


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One picture: colour, depth, and the pose of the camera.

    Attributes:
        number: number of the picture; each robot counts its own from 0.
        color: (height, width, 3) uint8, RGB.
        depth: (height, width) float32, metres along the optical axis; infinite where nothing is.
        intrinsics: of the camera.
        pose: pose of `camera_optical` in `map`.
    """

    number: int
    color: "NDArray[np.uint8]"
    depth: "NDArray[np.float32]"
    intrinsics: Intrinsics
    pose: Pose

    @property
    def coming(self) -> bool:
        """Whether its pixels are still being rendered elsewhere; reading them waits for that."""
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
        label: name of the object in the ontology.
        confidence: in [0, 1].
        box: its bounding box in the picture.
        mask: (box.height, box.width) bool, the thing's pixels inside the box.
        points: (n, 3) float32, its visible surface in `map` (metres); empty until located by depth.
        cut_off: whether it touches the edge of the picture, so that a part may be outside.
    """

    label: str
    confidence: float
    box: Box
    mask: "NDArray[np.bool_]"
    points: "NDArray[np.float32]" = field(default_factory=_no_points)
    cut_off: bool = False

    @property
    def position(self) -> Vector3 | None:
        """Median of `points` in `map` (metres); None before the thing is located."""
        if not len(self.points):
            return None
        from numpy import median

        x, y, z = (float(v) for v in median(self.points, axis=0))
        return x, y, z
