"""Rigid transforms, and back-projection of pixels with depth to points in `map`.

Importing SciPy takes as long as a whole mission in the instant world, which needs only a few of its
functions. They are written out here, and give the same numbers to the last bit.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from executive.types.geometry import Pose, Quaternion, Vector3
from executive.types.perception import Frame, Intrinsics

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

Floats = NDArray[np.float64]


def back_project(
    frame: Frame, rows: NDArray[np.intp], columns: NDArray[np.intp]
) -> NDArray[np.float32]:
    """Points in `map` (n, 3; metres) at these pixels; pixels without depth are left out."""
    depth = frame.depth[rows, columns]
    hit = np.isfinite(depth)
    in_camera = rays(frame.intrinsics, rows[hit], columns[hit]) * depth[hit, None]
    return transform(frame.pose, in_camera).astype(np.float32)


def back_project_grid(frame: Frame, rows: slice, columns: slice) -> Floats:
    """Points in `map` (h, w, 3; metres) of a part of the picture; NaN where there is no depth."""
    row, column = np.mgrid[rows, columns]
    depth = frame.depth[rows, columns].astype(np.float64).ravel()
    depth[~np.isfinite(depth)] = np.nan
    in_camera = rays(frame.intrinsics, row.ravel(), column.ravel()) * depth[:, None]
    return transform(frame.pose, in_camera).reshape(*row.shape, 3)


def rays(intrinsics: Intrinsics, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> Floats:
    """Rays (n, 3) in `camera_optical` through pixels, with z = 1.

    As in OpenCV and ROS, integer coordinates are the centres of pixels.
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
    moved: Floats = turned(pose.orientation, points) + pose.position
    return moved


def turned(orientation: Quaternion, vectors: Floats) -> Floats:
    """Rotate vectors (n, 3)."""
    result: Floats = np.asarray(vectors, np.float64) @ matrix_of(orientation).T
    return result


def matrix_of(orientation: Quaternion) -> Floats:
    """The rotation matrix (3, 3) of a quaternion (x, y, z, w) of any length but 0."""
    x, y, z, w = orientation
    length = math.sqrt(x * x + y * y + z * z + w * w)
    x, y, z, w = x / length, y / length, z / length, w / length
    xx, yy, zz, ww = x * x, y * y, z * z, w * w
    xy, xz, yz, xw, yw, zw = x * y, x * z, y * z, x * w, y * w, z * w
    return np.array(
        [
            [xx - yy - zz + ww, 2 * (xy - zw), 2 * (xz + yw)],
            [2 * (xy + zw), -xx + yy - zz + ww, 2 * (yz - xw)],
            [2 * (xz - yw), 2 * (yz + xw), -xx - yy + zz + ww],
        ]
    )


def heading(yaw: float) -> Quaternion:
    """The quaternion of a rotation about z by `yaw` (radians, to the left seen from above)."""
    return 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)


def orientation_of(angles: Sequence[float]) -> Quaternion:
    """The quaternion of rotations (radians) about the fixed axes x, then y, then z."""
    orientation = _about(0, angles[0])
    for axis in (1, 2):
        orientation = _product(_about(axis, angles[axis]), orientation)
    return orientation


def _about(axis: int, angle: float) -> Quaternion:
    sines = [0.0, 0.0, 0.0]
    sines[axis] = math.sin(angle / 2)
    x, y, z = sines
    return x, y, z, math.cos(angle / 2)


def _product(after: Quaternion, first: Quaternion) -> Quaternion:
    """The quaternion of rotation `first` followed by `after`."""
    ax, ay, az, aw = after
    x, y, z, w = first
    return (
        aw * x + w * ax + (ay * z - az * y),
        aw * y + w * ay + (az * x - ax * z),
        aw * z + w * az + (ax * y - ay * x),
        aw * w - ax * x - ay * y - az * z,
    )


def vector3(values: Sequence[float] | Floats) -> Vector3:
    """Three Python floats, as records need, from NumPy numbers."""
    x, y, z = (float(one) for one in values)
    return x, y, z


def pose_from(position: Sequence[float] | Floats, turn: "Rotation") -> Pose:
    """A pose with this position (3,; metres) and rotation."""
    x, y, z, w = (float(one) for one in turn.as_quat())
    return Pose(vector3(position), (x, y, z, w))


def seen_from(one: Pose, other: Pose) -> Pose:
    """Express pose `other` in the frame `one`; both are given in the same parent frame."""
    from scipy.spatial.transform import Rotation  # slow to import, see above

    back = Rotation.from_quat(one.orientation).inv()
    offset = np.subtract(other.position, one.position)
    return pose_from(back.apply(offset), back * Rotation.from_quat(other.orientation))


def carried_by(one: Pose, other: Pose) -> Pose:
    """Express pose `other`, given in the frame `one`, in the parent frame of `one`."""
    from scipy.spatial.transform import Rotation  # slow to import, see above

    turn = Rotation.from_quat(one.orientation)
    return pose_from(
        turn.apply(other.position) + one.position, turn * Rotation.from_quat(other.orientation)
    )
