"""The topics of a recording, and what is on them."""

from typing import Any

from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate

from logs.recording.mcap_file import MOST_IN_A_RECORD, MiB
from logs.recording.schema import MESSAGES, PACKAGE

TOPICS: dict[str, Any] = {
    "/bt/tree": MESSAGES["BehaviourTree"],
    "/bt/tick": MESSAGES["Tick"],
    "/llm/call": MESSAGES["LlmCall"],
    "/llm/verification": MESSAGES["LlmVerification"],
    "/dialog": MESSAGES["Utterance"],
    "/event": MESSAGES["Event"],
    "/camera/image/compressed": CompressedImage,
    "/camera/camera_info": CameraCalibration,
    "/camera/annotations": ImageAnnotations,
    "/tf": FrameTransforms,
    "/scene": SceneUpdate,
    "/mishap": MESSAGES["Mishap"],
    "/log": Log,
    "/outcome": MESSAGES["Outcome"],
}
"""Every topic with the class of its messages; all are declared in every file, used or not."""

MOST_IN_A_MESSAGE = 4 * MiB
"""Of one message of our own (bytes)."""


def is_own(topic: str) -> bool:
    """Whether its messages are defined here, and not by Foxglove."""
    package: str = TOPICS[topic].DESCRIPTOR.file.package
    return package == PACKAGE


def most_in(topic: str) -> int:
    """How long a message on it may be (bytes): a longer one is neither written nor read."""
    return MOST_IN_A_MESSAGE if is_own(topic) else MOST_IN_A_RECORD // 2
