"""Converts records to Foxglove's well-known messages: pictures, frames, scene, log lines."""

from mimetypes import guess_type
from pathlib import Path

from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.Color_pb2 import Color as ColorMessage
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.Point2_pb2 import Point2
from foxglove_schemas_protobuf.Point3_pb2 import Point3
from foxglove_schemas_protobuf.PointsAnnotation_pb2 import PointsAnnotation
from foxglove_schemas_protobuf.Pose_pb2 import Pose as PoseMessage
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion as QuaternionMessage
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from foxglove_schemas_protobuf.SceneEntityDeletion_pb2 import SceneEntityDeletion
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3 as Vector3Message
from google.protobuf.timestamp_pb2 import Timestamp

from executive.colors import Color
from executive.records import (
    Entity,
    Note,
    Picture,
    PlannedPath,
    Scene,
    Seen,
    Shape,
    Transform,
    Transforms,
)
from executive.types.geometry import Pose, Quaternion, Vector3
from executive.types.perception import Box
from logs.images import jpeg

CAMERA_FRAME = "camera_optical"
PATH_ID = "planned_path"
FOUND: Color = (0.2, 0.9, 0.3, 1.0)
PLANNED: Color = (0.1, 0.5, 1.0, 1.0)


def timestamp(ns: int) -> Timestamp:
    """Nanoseconds since 1970 as a message."""
    return Timestamp(seconds=ns // 1_000_000_000, nanos=ns % 1_000_000_000)


def compressed_image(picture: Picture, ns: int) -> CompressedImage:
    """The colours as JPEG."""
    return CompressedImage(
        timestamp=timestamp(ns), frame_id=CAMERA_FRAME, data=jpeg(picture.frame), format="jpeg"
    )


def camera_calibration(picture: Picture, ns: int) -> CameraCalibration:
    """The intrinsics of a pinhole camera without distortion."""
    i = picture.frame.intrinsics
    return CameraCalibration(
        timestamp=timestamp(ns),
        frame_id=CAMERA_FRAME,
        width=i.width,
        height=i.height,
        K=[i.fx, 0, i.cx, 0, i.fy, i.cy, 0, 0, 1],
        R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
        P=[i.fx, 0, i.cx, 0, 0, i.fy, i.cy, 0, 0, 0, 1, 0],
    )


def image_annotations(seen: Seen, ns: int) -> ImageAnnotations:
    """A rectangle and a label around each detection; `ns` is the time of the picture."""
    message = ImageAnnotations(timestamp=timestamp(ns))
    message.metadata.add(key="frame_number", value=str(seen.frame_number))
    for detection in seen.detections:
        box = detection.box
        outline = message.points.add(
            timestamp=timestamp(ns),
            type=PointsAnnotation.LINE_LOOP,
            points=_corners(box),
            outline_color=_color(FOUND),
            thickness=2,
        )
        outline.metadata.add(key="label", value=detection.label)
        outline.metadata.add(key="confidence", value=f"{detection.confidence:.3f}")
        message.texts.add(
            timestamp=timestamp(ns),
            position=Point2(x=box.left, y=box.top),
            text=f"{detection.label} {detection.confidence:.2f}",
            font_size=12,
            text_color=_color((0, 0, 0, 1)),
            background_color=_color(FOUND),
        )
    return message


def camera_transform(picture: Picture, ns: int) -> FrameTransforms:
    """The pose of the camera in `map` when it took the picture."""
    pose = Transform("map", CAMERA_FRAME, picture.frame.pose)
    return frame_transforms(Transforms((pose,)), ns)


def frame_transforms(transforms: Transforms, ns: int) -> FrameTransforms:
    """The pose of each frame in its parent frame."""
    time = timestamp(ns)
    message = FrameTransforms()
    for t in transforms.transforms:
        message.transforms.add(
            timestamp=time,
            parent_frame_id=t.parent,
            child_frame_id=t.child,
            translation=_vector(t.pose.position),
            rotation=_quaternion(t.pose.orientation),
        )
    return message


def scene_update(scene: Scene, ns: int) -> SceneUpdate:
    """Things with their shapes, each fixed in its frame.

    Raises:
        ValueError: if a shape is of an unknown kind, or its mesh cannot be read.
    """
    return SceneUpdate(entities=[_entity(e, ns) for e in scene.entities])


def path_update(path: PlannedPath, ns: int) -> SceneUpdate:
    """The planned path as a line just above the floor; without points, the line is removed."""
    if not path.points:
        return SceneUpdate(deletions=[SceneEntityDeletion(timestamp=timestamp(ns), id=PATH_ID)])
    entity = SceneEntity(timestamp=timestamp(ns), frame_id="map", id=PATH_ID)
    entity.lines.add(
        type=LinePrimitive.LINE_STRIP,
        pose=_pose(Pose((0.0, 0.0, 0.02))),
        thickness=0.04,
        points=[Point3(x=x, y=y, z=z) for x, y, z in path.points],
        color=_color(PLANNED),
    )
    return SceneUpdate(entities=[entity])


def log_line(note: Note, ns: int) -> Log:
    """A log line."""
    return Log(
        timestamp=timestamp(ns),
        level=Log.Level.Value(note.level.upper()),
        message=note.text,
        name="executive",
    )


def _entity(entity: Entity, ns: int) -> SceneEntity:
    message = SceneEntity(
        timestamp=timestamp(ns), frame_id=entity.frame_id, id=entity.name, frame_locked=True
    )
    for shape in entity.shapes:
        _add_shape(message, shape)
    return message


def _add_shape(message: SceneEntity, shape: Shape) -> None:
    pose, size, color = _pose(shape.pose), _vector(shape.size), _color(shape.color)
    match shape.kind:
        case "box":
            message.cubes.add(pose=pose, size=size, color=color)
        case "cylinder":
            message.cylinders.add(
                pose=pose, size=size, color=color, bottom_scale=1.0, top_scale=1.0
            )
        case "sphere":
            message.spheres.add(pose=pose, size=size, color=color)
        case "mesh":
            message.models.add(
                pose=pose,
                scale=size,
                color=color,
                override_color=not shape.mesh.endswith(".glb"),
                media_type=guess_type(shape.mesh)[0] or "model/obj",
                data=_mesh(Path(shape.mesh)),
            )
        case kind:
            raise ValueError(f"shape of unknown kind {kind!r}: box, cylinder, sphere or mesh")


def _mesh(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError as error:
        raise ValueError(f"the mesh {file} cannot be read: {error.strerror}") from error


def _corners(box: Box) -> list[Point2]:
    right, bottom = box.left + box.width, box.top + box.height
    corners = ((box.left, box.top), (right, box.top), (right, bottom), (box.left, bottom))
    return [Point2(x=x, y=y) for x, y in corners]


def _color(color: Color) -> ColorMessage:
    r, g, b, a = color
    return ColorMessage(r=r, g=g, b=b, a=a)


def _vector(vector: Vector3) -> Vector3Message:
    x, y, z = vector
    return Vector3Message(x=x, y=y, z=z)


def _quaternion(quaternion: Quaternion) -> QuaternionMessage:
    x, y, z, w = quaternion
    return QuaternionMessage(x=x, y=y, z=z, w=w)


def _pose(pose: Pose) -> PoseMessage:
    return PoseMessage(position=_vector(pose.position), orientation=_quaternion(pose.orientation))
