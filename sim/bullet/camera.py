"""The simulated camera, and a stand-in for a learned detector."""

from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping
from itertools import count

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from executive.types.geometry import Pose
from executive.types.perception import Box, Detection, Frame, Intrinsics
from sim.bullet.rendering import DAYLIGHT, NEAR_M, Light, Rendering, View, draw
from sim.engine import BulletClient

FAR_M = 15.0
"""Range of the camera."""
KEPT_SEGMENTATIONS = 4
"""The segmentations of this many pictures are kept, for detectors that read them."""
_OPTICAL_TO_OPENGL = np.diag([1.0, -1.0, -1.0, 1.0])
"""OpenGL cameras look along -z with y up, optical frames along z with y down."""


def pinhole(width: int, height: int, hfov: float = np.radians(65.0)) -> Intrinsics:
    """A camera with square pixels and a horizontal field of view (radians)."""
    focal = width / 2 / float(np.tan(hfov / 2))
    return Intrinsics(width, height, focal, focal, (width - 1) / 2, (height - 1) / 2)


LOOKING = pinhole(640, 480)
"""The camera for recognising objects."""
GLANCING = pinhole(320, 240)
"""The same camera with a quarter of the pixels, for pictures that must be cheap."""


def render(
    client: BulletClient,
    pose: Pose,
    intrinsics: Intrinsics,
    far: float = FAR_M,
    light: Light = DAYLIGHT,
) -> Rendering:
    """Draw what a camera with its optical frame at `pose` in `map` sees, up to `far` metres."""
    return draw(client, view_from(pose, intrinsics, far, light))


def view_from(
    pose: Pose, intrinsics: Intrinsics, far: float = FAR_M, light: Light = DAYLIGHT
) -> View:
    """The view of a camera with its optical frame at `pose` in `map`."""
    return View(
        intrinsics.width,
        intrinsics.height,
        _view_matrix(pose),
        _projection_matrix(intrinsics, far),
        far,
        light,
    )


class SimulatedCamera:
    """A colour and depth camera in a PyBullet world; a `Camera`."""

    def __init__(
        self,
        client: BulletClient,
        pose: Callable[[], Pose],
        lens: Intrinsics = LOOKING,
        numbers: Iterator[int] | None = None,
    ) -> None:
        """Make a camera.

        Args:
            client: the world.
            pose: returns the current pose of the optical frame in `map`.
            lens: size of the pictures, and intrinsics.
            numbers: gives each picture its number; cameras that share it count together.
        """
        self._client = client
        self.pose = pose
        self.lens = lens
        self.numbers = count() if numbers is None else numbers
        self._segmentations: OrderedDict[int, NDArray[np.int32]] = OrderedDict()

    def capture(self) -> Frame:
        """Take a picture now."""
        pose = self.pose()
        seen = render(self._client, pose, self.lens)
        frame = Frame(next(self.numbers), seen.color, seen.depth, self.lens, pose)
        self._segmentations[frame.number] = seen.segmentation
        if len(self._segmentations) > KEPT_SEGMENTATIONS:
            self._segmentations.popitem(last=False)
        return frame

    def segmentation(self, number: int) -> NDArray[np.int32]:
        """The ground-truth segmentation of a recent picture: body ids (height, width).

        Only for detectors that stand in for a learned one.

        Raises:
            KeyError: if the picture is not one of the last KEPT_SEGMENTATIONS.
        """
        return self._segmentations[number]


class SimulatedDetector:
    """Stands in for a learned detector: it reads the ground-truth segmentation, so it never errs.

    It neither confuses nor overlooks objects that show enough pixels. Positions in space are not
    taken from the simulator: they are computed from the depth, as with any detector.
    """

    def __init__(
        self, camera: SimulatedCamera, names: Mapping[int, str], minimum_pixels: int = 160
    ) -> None:
        """Recognise the bodies in `names` (names by body id) that show `minimum_pixels` or more."""
        self._camera = camera
        self._names = names
        self._minimum_pixels = minimum_pixels

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All known objects in the picture, with confidence 1, in order of falling pixel count."""
        segmentation = self._camera.segmentation(frame.number)
        bodies, counts = np.unique(segmentation, return_counts=True)
        large_first = sorted(zip(counts.tolist(), bodies.tolist(), strict=True), reverse=True)
        return tuple(
            _detection(self._names[body], segmentation == body)
            for count, body in large_first
            if body in self._names and count >= self._minimum_pixels
        )


def _detection(label: str, mask: NDArray[np.bool_]) -> Detection:
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    top, left = int(rows[0]), int(columns[0])
    height, width = int(rows[-1]) - top + 1, int(columns[-1]) - left + 1
    inside = mask[top : top + height, left : left + width].copy()
    return Detection(label, 1.0, Box(left, top, width, height), inside)


def _view_matrix(pose: Pose) -> tuple[float, ...]:
    """The transform from `map` to OpenGL's camera frame, 4 x 4, column-major."""
    camera_to_map = np.eye(4)
    camera_to_map[:3, :3] = Rotation.from_quat(pose.orientation).as_matrix()
    camera_to_map[:3, 3] = pose.position
    view = _OPTICAL_TO_OPENGL @ np.linalg.inv(camera_to_map)
    return tuple(view.T.ravel().tolist())


def _projection_matrix(intrinsics: Intrinsics, far: float) -> tuple[float, ...]:
    """OpenGL's projection of a pinhole camera, 4 x 4, column-major.

    TinyRenderer samples a pixel at its lower left corner, not at its centre: column u is drawn at
    2 u / width - 1 and row v at 1 - 2 (v + 1) / height (normalised device coordinates).
    """
    width, height = intrinsics.width, intrinsics.height
    projection = np.zeros((4, 4))
    projection[0, 0] = 2 * intrinsics.fx / width
    projection[1, 1] = 2 * intrinsics.fy / height
    projection[0, 2] = 1 - 2 * intrinsics.cx / width
    projection[1, 2] = 2 * (intrinsics.cy + 1) / height - 1
    projection[2, 2] = -(far + NEAR_M) / (far - NEAR_M)
    projection[2, 3] = -2 * far * NEAR_M / (far - NEAR_M)
    projection[3, 2] = -1
    return tuple(projection.T.ravel().tolist())
