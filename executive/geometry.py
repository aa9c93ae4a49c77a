"""Points and frames: from pixels with depth to points in `map`, from one frame to another."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from executive.types import Frame, Intrinsics, Pose

Floats = NDArray[np.float64]


def back_project(
    frame: Frame, rows: NDArray[np.intp], columns: NDArray[np.intp]
) -> NDArray[np.float32]:
    """Points in `map` (n, 3; metres) seen at these pixels; pixels without depth are left out."""
    depth = frame.depth[rows, columns]
    hit = np.isfinite(depth)
    in_camera = rays(frame.intrinsics, rows[hit], columns[hit]) * depth[hit, None]
    return transform(frame.pose, in_camera).astype(np.float32)


def back_project_grid(frame: Frame, rows: slice, columns: slice) -> Floats:
    """Points in `map` (h, w, 3; metres) seen in a part of the picture; NaN without depth."""
    row, column = np.mgrid[rows, columns]
    depth = frame.depth[rows, columns].astype(np.float64).ravel()
    depth[~np.isfinite(depth)] = np.nan
    in_camera = rays(frame.intrinsics, row.ravel(), column.ravel()) * depth[:, None]
    return transform(frame.pose, in_camera).reshape(*row.shape, 3)


def rays(intrinsics: Intrinsics, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> Floats:
    """Directions (n, 3) in `camera_optical` through pixels, with z = 1.

    As in OpenCV and ROS, whole coordinates are the middles of pixels.
    """
    return np.stack(
        [
            (columns - intrinsics.cx) / intrinsics.fx,
            (rows - intrinsics.cy) / intrinsics.fy,
            np.ones(len(rows)),
        ],
        axis=-1,
    )


def transform(pose: Pose, points: Floats) -> Floats:
    """Points (n, 3) from the child frame of `pose` to its parent frame."""
    moved: Floats = Rotation.from_quat(pose.orientation).apply(points) + pose.position
    return moved


def pose_from(position: Floats, turn: Rotation) -> Pose:
    """A pose at this position (3,; metres), turned so."""
    x, y, z = (float(one) for one in position)
    a, b, c, d = (float(one) for one in turn.as_quat())
    return Pose((x, y, z), (a, b, c, d))


def seen_from(one: Pose, other: Pose) -> Pose:
    """`other` in the frame `one`, if both are in the same frame."""
    back = Rotation.from_quat(one.orientation).inv()
    offset = np.subtract(other.position, one.position)
    return pose_from(back.apply(offset), back * Rotation.from_quat(other.orientation))


def carried_by(one: Pose, other: Pose) -> Pose:
    """`other`, told in the frame `one`, in the frame that `one` is told in."""
    turn = Rotation.from_quat(one.orientation)
    return pose_from(
        turn.apply(other.position) + one.position, turn * Rotation.from_quat(other.orientation)
    )
