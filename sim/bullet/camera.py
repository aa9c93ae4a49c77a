"""The simulated camera, and a stand-in for a learned detector.

Pictures come from PyBullet's TinyRenderer, which computes on the CPU.
"""

from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import count

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from executive.types import Box, Detection, Frame, Intrinsics, Pose, Vector3
from sim.engine import BulletClient
from sim.engine import pybullet as p

NEAR_M, FAR_M = 0.05, 15.0
BACKGROUND = -1
KEPT_SEGMENTATIONS = 4
_OPTICAL_TO_OPENGL = np.diag([1.0, -1.0, -1.0, 1.0])
"""OpenGL cameras look along -z with y up, optical frames along z with y down."""


@dataclass(frozen=True, slots=True)
class Light:
    """One lamp at infinity, and what comes from everywhere.

    Attributes:
        direction: towards the lamp, in `map`.
        color: of the lamp; red, green, blue in [0, 1].
        ambient: share of a surface's colour that it shows without the lamp.
        diffuse: share that the lamp adds where it shines straight on it.
        specular: strength of reflections.
    """

    direction: Vector3 = (-0.4, -0.3, 1.0)
    color: Vector3 = (1.0, 1.0, 1.0)
    ambient: float = 0.65
    diffuse: float = 0.4
    specular: float = 0.02


DAYLIGHT = Light()


@dataclass(frozen=True, slots=True, eq=False)
class Rendering:
    """What the renderer says of one picture.

    Attributes:
        color: (height, width, 3) uint8, RGB.
        depth: (height, width) float32, metres along the optical axis, infinite where nothing is.
        segmentation: (height, width) int32, body ids; BACKGROUND where nothing is.
    """

    color: NDArray[np.uint8]
    depth: NDArray[np.float32]
    segmentation: NDArray[np.int32]


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
    width, height = intrinsics.width, intrinsics.height
    _, _, color, depth, segmentation = client.getCameraImage(
        width,
        height,
        _view_matrix(pose),
        _projection_matrix(intrinsics, far),
        lightDirection=light.direction,
        lightColor=light.color,
        lightAmbientCoeff=light.ambient,
        lightDiffuseCoeff=light.diffuse,
        lightSpecularCoeff=light.specular,
        shadow=0,
        renderer=p.ER_TINY_RENDERER,
    )
    bodies = np.reshape(segmentation, (height, width)).astype(np.int32)
    buffer = np.reshape(depth, (height, width)).astype(np.float64)
    metres = far * NEAR_M / (far - (far - NEAR_M) * buffer)
    metres[bodies == BACKGROUND] = np.inf
    pixels = np.reshape(color, (height, width, 4))[..., :3].astype(np.uint8)
    return Rendering(pixels, metres.astype(np.float32), bodies)


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
        self._pose = pose
        self._lens = lens
        self._numbers = count() if numbers is None else numbers
        self._segmentations: OrderedDict[int, NDArray[np.int32]] = OrderedDict()

    def capture(self) -> Frame:
        """The picture of this moment."""
        pose = self._pose()
        seen = render(self._client, pose, self._lens)
        frame = Frame(next(self._numbers), seen.color, seen.depth, self._lens, pose)
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


def _view_matrix(pose: Pose) -> list[float]:
    """`map` in OpenGL's camera frame, column by column."""
    camera_to_map = np.eye(4)
    camera_to_map[:3, :3] = Rotation.from_quat(pose.orientation).as_matrix()
    camera_to_map[:3, 3] = pose.position
    view = _OPTICAL_TO_OPENGL @ np.linalg.inv(camera_to_map)
    return [float(value) for value in view.T.ravel()]


def _projection_matrix(intrinsics: Intrinsics, far: float) -> list[float]:
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
    return [float(value) for value in projection.T.ravel()]
