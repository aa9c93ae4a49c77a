"""Draws the home, the robot, its path and what it sees in rerun.

Everything drawn names its frame (`CoordinateFrame`), and frames are connected by named transforms,
so entity paths have no geometric meaning.
"""

from collections.abc import Iterable, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import rerun as rr

from executive.colors import Color
from executive.records import Entity, PlannedPath, Seen, Shape, Transform
from executive.types.geometry import Pose
from executive.types.perception import Intrinsics
from logs.viewer.timelines import At, time_columns

FRAMES = "frames"
SCENE = "scene"
PLAN = "plan"
CAMERA = "camera"
CAMERA_POSE = "camera/pose"
DETECTIONS = "camera/detections"
PICTURE_FRAME = "picture"
"""The frame of the camera at the time of the latest picture."""
IMAGE_FRAME = "picture_plane"
PICTURE_WIDTH = 640
"""Width of every picture (pixels). The viewer treats consecutive JPEGs as a video, which has one
size; but pictures that the robot evaluates are larger than those taken on the way.
"""

_GLTF_TURN = (0.5, 0.5, 0.5, 0.5)
"""glTF has y up and looks along z; the viewer does not convert its coordinates."""
_CAMERA = (255, 255, 255, 160)
_FOUND = (60, 220, 90)
_PLANNED = (30, 130, 255)


class Taken(NamedTuple):
    """A picture as JPEG, and the pose of the camera in `map`."""

    pose: Pose
    jpeg: bytes


def log_frames(stream: rr.RecordingStream) -> None:
    """Log the frames of things that come and go.

    All frames must be connected from the start, so before the first picture the camera has a pose,
    but is not shown.
    """
    stream.log(PLAN, rr.CoordinateFrame("map"), static=True)
    stream.log(CAMERA, rr.CoordinateFrame(IMAGE_FRAME), static=True)
    stream.log(DETECTIONS, rr.CoordinateFrame(IMAGE_FRAME), static=True)
    stream.log(
        CAMERA_POSE,
        rr.Transform3D(translation=(0, 0, 0), parent_frame="map", child_frame=PICTURE_FRAME),
    )
    log_intrinsics(stream, Intrinsics(1, 1, 1.0, 1.0, 0.5, 0.5), 1e-6)


def log_scene(stream: rr.RecordingStream, entities: Iterable[Entity]) -> None:
    """Log all shapes once; afterwards, only their frames move.

    Raises:
        ValueError: if a shape is of an unknown kind, or its mesh is missing.
    """
    for entity in entities:
        by_kind = sorted(entity.shapes, key=lambda shape: shape.kind)
        for kind, shapes in groupby(by_kind, key=lambda shape: shape.kind):
            _log_shapes(stream, entity, kind, list(shapes))


def _log_shapes(stream: rr.RecordingStream, entity: Entity, kind: str, shapes: list[Shape]) -> None:
    frame = rr.CoordinateFrame(entity.frame_id)
    sizes = np.array([shape.size for shape in shapes])
    placed: dict[str, Any] = {
        "centers": [shape.pose.position for shape in shapes],
        "quaternions": [shape.pose.orientation for shape in shapes],
        "colors": [_rgba(shape.color) for shape in shapes],
        "fill_mode": "solid",
    }
    path = rr.new_entity_path([SCENE, entity.name, kind])
    match kind:
        case "box":
            stream.log(path, frame, rr.Boxes3D(sizes=sizes, **placed), static=True)
        case "cylinder":
            solid = rr.Cylinders3D(lengths=sizes[:, 2], radii=sizes[:, 0] / 2, **placed)
            stream.log(path, frame, solid, static=True)
        case "sphere":
            stream.log(path, frame, rr.Ellipsoids3D(half_sizes=sizes / 2, **placed), static=True)
        case "mesh":
            for number, shape in enumerate(shapes):
                _log_mesh(stream, f"{path}/{number}", frame, shape)
        case _:
            raise ValueError(f"shape of unknown kind {kind!r}: box, cylinder, sphere or mesh")


def _log_mesh(
    stream: rr.RecordingStream, path: str, frame: rr.CoordinateFrame, shape: Shape
) -> None:
    if not Path(shape.mesh).is_file():
        raise ValueError(f"the mesh {shape.mesh} is not there")
    from scipy.spatial.transform import Rotation  # slow to import, and meshes are rare

    turn = Rotation.from_quat(shape.pose.orientation)
    if shape.mesh.endswith(".glb"):
        turn *= Rotation.from_quat(_GLTF_TURN)
    stream.log(
        path,
        frame,
        rr.Asset3D(path=Path(shape.mesh), albedo_factor=_rgba(shape.color)),
        rr.InstancePoses3D(
            translations=[shape.pose.position],
            quaternions=[turn.as_quat()],
            scales=[shape.size],
        ),
        static=True,
    )


def send_transforms(stream: rr.RecordingStream, moved: Sequence[At[Transform]]) -> None:
    """Send the poses of frames in their parents, one row each."""
    transforms = [at.value for at in moved]
    stream.send_columns(
        FRAMES,
        time_columns([at.moment for at in moved]),
        rr.Transform3D.columns(
            translation=[t.pose.position for t in transforms],
            quaternion=[t.pose.orientation for t in transforms],
            parent_frame=[t.parent for t in transforms],
            child_frame=[t.child for t in transforms],
        ),
    )


def log_path(stream: rr.RecordingStream, path: PlannedPath) -> None:
    """Log the planned path as a line just above the floor; without points, there is no line."""
    strips = [np.array(path.points) + (0.0, 0.0, 0.02)] if path.points else []
    stream.log(PLAN, rr.LineStrips3D(strips, colors=_PLANNED, radii=0.02))


def log_intrinsics(stream: rr.RecordingStream, i: Intrinsics, reach_m: float = 0.6) -> None:
    """Log a pinhole camera; its picture is drawn at a distance of `reach_m` (m)."""
    stream.log(
        CAMERA,
        rr.Pinhole(
            image_from_camera=np.array([[i.fx, 0, i.cx], [0, i.fy, i.cy], [0, 0, 1]]),
            width=i.width,
            height=i.height,
            parent_frame=PICTURE_FRAME,
            child_frame=IMAGE_FRAME,
            image_plane_distance=reach_m,
            color=_CAMERA,
            line_width=reach_m / 100,
        ),
    )


def send_pictures(stream: rr.RecordingStream, taken: Sequence[At[Taken]]) -> None:
    """Send pictures with the poses of the camera, one row each."""
    times = time_columns([at.moment for at in taken])
    pictures = [at.value for at in taken]
    count = len(pictures)
    stream.send_columns(
        CAMERA_POSE,
        times,
        rr.Transform3D.columns(
            translation=[p.pose.position for p in pictures],
            quaternion=[p.pose.orientation for p in pictures],
            parent_frame=["map"] * count,
            child_frame=[PICTURE_FRAME] * count,
        ),
    )
    stream.send_columns(
        CAMERA,
        times,
        rr.EncodedImage.columns(blob=[p.jpeg for p in pictures], media_type=["image/jpeg"] * count),
    )


def clear_detections(stream: rr.RecordingStream) -> None:
    """Remove the detections of the last picture."""
    stream.log(DETECTIONS, rr.Clear(recursive=False))


def log_detections(stream: rr.RecordingStream, seen: Seen, scale: float) -> None:
    """Log a labelled rectangle for each detection, on a picture scaled by `scale`."""
    boxes = [d.box for d in seen.detections]
    stream.log(
        DETECTIONS,
        rr.Boxes2D(
            mins=[(scale * box.left, scale * box.top) for box in boxes],
            sizes=[(scale * box.width, scale * box.height) for box in boxes],
            labels=[f"{d.label} {d.confidence:.2f}" for d in seen.detections],
            colors=_FOUND,
        ),
    )


def _rgba(color: Color) -> tuple[int, int, int, int]:
    r, g, b, a = (round(255 * channel) for channel in color)
    return r, g, b, a
