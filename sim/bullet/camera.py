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
KEPT_SEGMENTATIONS = 4
_OPTICAL_TO_OPENGL = np.diag([1.0, -1.0, -1.0, 1.0])
"""OpenGL cameras look along -z with y up, optical frames along z with y down."""


def pinhole(width: int, height: int, hfov: float = np.radians(65.0)) -> Intrinsics:
    """A camera with square pixels and a horizontal field of view (radians)."""
    focal = width / 2 / float(np.tan(hfov / 2))
    return Intrinsics(width, height, focal, focal, (width - 1) / 2, (height - 1) / 2)


LOOKING = pinhole(640, 480)
"""The camera that things are recognised with."""
GLANCING = pinhole(320, 240)
"""The same with pixels four times as large, where a picture must cost little."""


def render(
    client: BulletClient,
    pose: Pose,
    intrinsics: Intrinsics,
    far: float = FAR_M,
    light: Light = DAYLIGHT,
) -> Rendering:
    """Draw the world, up to `far` metres, as a camera sees it whose optical frame is at `pose`."""
    return draw(client, view_from(pose, intrinsics, far, light))


def view_from(
    pose: Pose, intrinsics: Intrinsics, far: float = FAR_M, light: Light = DAYLIGHT
) -> View:
    """What a camera shows whose optical frame is at `pose` in `map`."""
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
        """Look through the camera whose optical frame in `map` is given by `pose`.

        Cameras that share `numbers` count their pictures together.
        """
        self._client = client
        self.pose = pose
        self.lens = lens
        self.numbers = count() if numbers is None else numbers
        self._segmentations: OrderedDict[int, NDArray[np.int32]] = OrderedDict()

    def capture(self) -> Frame:
        """The picture of this moment."""
        pose = self.pose()
        seen = render(self._client, pose, self.lens)
        frame = Frame(next(self.numbers), seen.color, seen.depth, self.lens, pose)
        self._segmentations[frame.number] = seen.segmentation
        if len(self._segmentations) > KEPT_SEGMENTATIONS:
            self._segmentations.popitem(last=False)
        return frame

    def segmentation(self, number: int) -> NDArray[np.int32]:
        """Body ids of a late picture (height, width): the renderer's truth, for stand-ins only.

        Raises:
            KeyError: if the picture is older than the last KEPT_SEGMENTATIONS.
        """
        return self._segmentations[number]


class SimulatedDetector:
    """Stands in for a learned detector: it reads the renderer's segmentation, so it is never wrong.

    It knows which pixel belongs to which body and therefore neither confuses nor overlooks anything
    that shows enough pixels. Where a thing is in space it does not know: that comes from the depth.
    """

    def __init__(
        self, camera: SimulatedCamera, names: Mapping[int, str], minimum_pixels: int = 160
    ) -> None:
        """Recognise the bodies in `names` (name by body id) that show `minimum_pixels`."""
        self._camera = camera
        self._names = names
        self._minimum_pixels = minimum_pixels

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All known things in the picture, all with confidence 1, those with most pixels first."""
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
    """`map` in OpenGL's camera frame, column by column."""
    camera_to_map = np.eye(4)
    camera_to_map[:3, :3] = Rotation.from_quat(pose.orientation).as_matrix()
    camera_to_map[:3, 3] = pose.position
    view = _OPTICAL_TO_OPENGL @ np.linalg.inv(camera_to_map)
    return tuple(view.T.ravel().tolist())


def _projection_matrix(intrinsics: Intrinsics, far: float) -> tuple[float, ...]:
    """OpenGL's projection of a pinhole camera, column by column.

    TinyRenderer samples a pixel at its lower left corner, not at its middle: column u is drawn at
    2 u / width - 1 and row v at 1 - 2 (v + 1) / height.
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
