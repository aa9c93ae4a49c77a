"""The contract of every Camera. An adapter's tests subclass `CameraContract`.

Provide a fixture `camera_bench` that yields a `CameraBench`: the camera, on a robot at rest.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from executive.interfaces.perception import Camera

NEAREST_M, FARTHEST_M = 0.02, 50.0
"""Depths outside of these limits are not in metres."""


@dataclass
class CameraBench:
    """A camera, and the position of its robot: x and y in `map` (metres)."""

    camera: Camera
    robot_at: tuple[float, float]
    reach_m: float = 1.0
    """The largest horizontal distance of the camera from there."""


class CameraContract:
    """Each method tests one requirement of `Camera` and `Frame`."""

    def test_pictures_are_rgb_bytes_and_depth_of_one_size(self, camera_bench: CameraBench) -> None:
        frame = camera_bench.camera.capture()
        size = (frame.intrinsics.height, frame.intrinsics.width)
        assert frame.color.shape == (*size, 3)
        assert frame.color.dtype == np.uint8
        assert frame.depth.shape == size
        assert frame.depth.dtype == np.float32

    def test_numbers_only_grow(self, camera_bench: CameraBench) -> None:
        numbers = [camera_bench.camera.capture().number for _ in range(4)]
        assert numbers[0] >= 0
        assert numbers == sorted(set(numbers))

    def test_the_lens_looks_ahead(self, camera_bench: CameraBench) -> None:
        lens = camera_bench.camera.capture().intrinsics
        assert 0 <= lens.cx < lens.width
        assert 0 <= lens.cy < lens.height
        assert 20.0 < np.degrees(2 * np.arctan(lens.width / 2 / lens.fx)) < 180.0
        assert 0.8 < lens.fx / lens.fy < 1.25

    def test_depth_is_in_metres_and_infinite_where_nothing_is(
        self, camera_bench: CameraBench
    ) -> None:
        depth = camera_bench.camera.capture().depth
        assert not np.isnan(depth).any()
        met = depth[np.isfinite(depth)]
        assert len(met) > 0.1 * depth.size
        assert met.min() > NEAREST_M
        assert met.max() < FARTHEST_M

    def test_it_says_where_it_is_in_the_map(self, camera_bench: CameraBench) -> None:
        pose = camera_bench.camera.capture().pose
        off = np.subtract(pose.position[:2], camera_bench.robot_at)
        assert np.hypot(*off) < camera_bench.reach_m
        assert 0.1 < pose.position[2] < 2.5
        assert abs(np.linalg.norm(pose.orientation) - 1.0) < 1e-3

    def test_what_it_sees_is_on_or_above_the_floor(self, camera_bench: CameraBench) -> None:
        frame = camera_bench.camera.capture()
        lens = frame.intrinsics
        rows, columns = np.nonzero(np.isfinite(frame.depth))
        depth = frame.depth[rows, columns].astype(np.float64)
        ahead = np.column_stack(
            ((columns - lens.cx) / lens.fx * depth, (rows - lens.cy) / lens.fy * depth, depth)
        )
        turn = Rotation.from_quat(frame.pose.orientation)
        heights = (turn.apply(ahead) + frame.pose.position)[:, 2]
        assert np.quantile(heights, 0.01) > -0.1

    def test_a_camera_at_rest_stays_where_it_is(self, camera_bench: CameraBench) -> None:
        one, other = (camera_bench.camera.capture().pose for _ in range(2))
        assert np.allclose(one.position, other.position, atol=1e-3)
