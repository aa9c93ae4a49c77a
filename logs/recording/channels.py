"""The content of a recording: for each kind of record, its topics, and how it is read back.

To add a kind of record, add its entry to `CHANNELS`; sink and reader need nothing else.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar, get_args

from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from google.protobuf.descriptor_pool import Default

from executive.records import (
    EventTaken,
    Finished,
    Intervention,
    LlmCall,
    Mishap,
    Note,
    Picture,
    Planned,
    PlannedPath,
    Recalled,
    Record,
    Scene,
    Seen,
    SourceAnswer,
    Tick,
    Transforms,
    TreeShape,
    Utterance,
    Verified,
    WaysTold,
)
from logs.recording import foxglove, plain
from logs.recording.context import Context
from logs.recording.events import event_from_message, event_to_fields, in_words
from logs.recording.foxglove import timestamp
from logs.recording.mcap_file import MOST_IN_A_RECORD, MiB
from logs.recording.messages import (
    finished_from_message,
    finished_to_fields,
    llm_call_from_message,
    llm_call_to_fields,
    tick_from_message,
    tick_to_fields,
    tree_from_message,
    tree_to_fields,
)
from logs.recording.schema import (
    EVENT,
    LLM_CALL,
    OUTCOME,
    PACKAGE,
    TICK,
    TREE,
    Definitions,
    Numbers,
    classes,
)

T = TypeVar("T")
R = TypeVar("R", bound=Record)


@dataclass(frozen=True, slots=True)
class Channel(Generic[R]):
    """A kind of record on a topic."""

    topic: str
    record: type[R]
    message: Any
    """Foxglove's class of the messages, or the name of our own message."""
    encode: Callable[[R, Context], Any]
    """Makes the message of a record; None if there is nothing to write."""
    decode: Callable[[Any], R] | None = None
    """Makes the record of a message; None if the message does not contain the whole record."""
    definitions: Definitions = field(default_factory=dict)
    """The definitions of our own message and its parts."""


def _own(
    topic: str,
    record: type[R],
    message: str,
    definitions: Definitions,
    to_fields: Callable[[R], dict[str, Any]],
    from_message: Callable[[Any], R],
    *,
    exact: bool = False,
) -> Channel[R]:
    """A channel with a message of our own; `exact`: also with the mission time, not rounded."""

    def encode(told: R, context: Context) -> Any:
        fields = to_fields(told)
        if exact:
            fields["mission_time_s"] = context.stamp.mission_s
        fields["timestamp"] = timestamp(context.ns)
        fields["wall_time"] = timestamp(context.stamp.wall_ns)
        return MESSAGES[message](**fields)

    return Channel(topic, record, message, encode, from_message, definitions)


def _plain(topic: str, record: type[R], message: str = "") -> Channel[R]:
    """A channel whose messages have the record's fields, and its name or the name `message`."""
    name = message or record.__name__
    definitions = plain.definition(record, name)
    return _own(
        topic, record, name, definitions, plain.to_fields(record), plain.from_message(record)
    )


def _foxglove(
    topic: str, record: type[R], message: Any, encode: Callable[[R, int], Any]
) -> Channel[R]:
    """A channel with a message of Foxglove's, for display only: it is not read back."""
    return Channel(topic, record, message, lambda told, context: encode(told, context.ns))


def _line(record: type[R], level: str, text: Callable[[R], str]) -> Channel[R]:
    """A channel that writes a log line, for viewers that do not know our messages."""

    def encode(told: R, ns: int) -> Log:
        return foxglove.log_line(Note(level, text(told)), ns)

    return _foxglove("/log", record, Log, encode)


def _camera_frame(picture: Picture, context: Context) -> FrameTransforms | None:
    """The pose of the camera, unless the robot publishes it itself."""
    if context.camera_frame_published:
        return None
    return foxglove.camera_transform(picture, context.ns)


def _annotations(seen: Seen, context: Context) -> ImageAnnotations:
    return foxglove.image_annotations(seen, context.taken_ns(seen.frame_number))


CHANNELS: tuple[Channel[Any], ...] = (
    _own("/bt/tree", TreeShape, "BehaviourTree", TREE, tree_to_fields, tree_from_message),
    _own("/bt/tick", Tick, "Tick", TICK, tick_to_fields, tick_from_message),
    _own("/llm/call", LlmCall, "LlmCall", LLM_CALL, llm_call_to_fields, llm_call_from_message),
    _plain("/llm/verification", Verified, "LlmVerification"),
    _plain("/source/answer", SourceAnswer),
    _plain("/recalled", Recalled),
    _plain("/plan", Planned),
    _line(Planned, "info", lambda planned: planned.text),
    _plain("/ways", WaysTold),
    _plain("/dialog", Utterance),
    _line(Utterance, "info", lambda said: f"{said.speaker}: {said.text}"),
    _own("/event", EventTaken, "Event", EVENT, event_to_fields, event_from_message, exact=True),
    _line(EventTaken, "debug", lambda taken: in_words(taken.event)),
    Channel("/tf", Picture, FrameTransforms, _camera_frame),
    _foxglove("/camera/camera_info", Picture, CameraCalibration, foxglove.camera_calibration),
    _foxglove("/camera/image/compressed", Picture, CompressedImage, foxglove.compressed_image),
    Channel("/camera/annotations", Seen, ImageAnnotations, _annotations),
    _foxglove("/tf", Transforms, FrameTransforms, foxglove.frame_transforms),
    _foxglove("/scene", Scene, SceneUpdate, foxglove.scene_update),
    _foxglove("/scene", PlannedPath, SceneUpdate, foxglove.path_update),
    _line(Mishap, "warning", lambda mishap: f"{mishap.fault}: {mishap.text}"),
    _plain("/mishap", Mishap),
    _plain("/intervention", Intervention),
    _foxglove("/log", Note, Log, foxglove.log_line),
    _line(Finished, "info", lambda end: f"{end.outcome.status}: {end.outcome.reason}"),
    _own("/outcome", Finished, "Outcome", OUTCOME, finished_to_fields, finished_from_message),
)
"""All topics with their contents. A record becomes a message on each of its channels, in order."""


def by_kind(
    channels: Iterable[Channel[Any]], kinds: Iterable[type]
) -> dict[type, tuple[Channel[Any], ...]]:
    """The channels of each kind of record.

    Raises:
        TypeError: if a kind has none.
    """
    found = {kind: tuple(c for c in channels if c.record is kind) for kind in kinds}
    if missing := [kind.__name__ for kind, entries in found.items() if not entries]:
        what = f"{', '.join(missing)} would not be recorded"
        raise TypeError(f"{what}: give each kind of record an entry in logs/recording/channels.py")
    return found


def named(pairs: Iterable[tuple[str, T]]) -> dict[str, T]:
    """Messages or topics by name.

    Raises:
        TypeError: if two have the same name.
    """
    found: dict[str, T] = {}
    for name, value in pairs:
        if found.setdefault(name, value) != value:
            raise TypeError(f"{name} is two things in logs/recording/channels.py: rename one")
    return found


OF_KIND = by_kind(CHANNELS, get_args(Record))

DEFINITIONS = named(pair for channel in CHANNELS for pair in channel.definitions.items())
"""The definitions of all our own messages."""

NUMBERS: Numbers = {
    (message, field): number
    for message, fields in DEFINITIONS.items()
    for number, field in enumerate(fields, start=1)
}
"""The field numbers that are written today."""

MESSAGES = classes(Default(), DEFINITIONS, NUMBERS)
"""The classes of our own messages by name: `MESSAGES["Tick"](tick=3)`."""

TOPICS = named((c.topic, MESSAGES.get(c.message, c.message)) for c in CHANNELS)
"""Every topic with its message class; every file declares all of them, used or not."""

MOST_IN_A_MESSAGE = 4 * MiB
"""Maximum size of a message of our own (bytes)."""


def is_own(topic: str) -> bool:
    """Whether its messages are defined here, and not by Foxglove."""
    package: str = TOPICS[topic].DESCRIPTOR.file.package
    return package == PACKAGE


def most_in(topic: str) -> int:
    """Maximum size of a message on a topic (bytes); a larger one is neither written nor read."""
    return MOST_IN_A_MESSAGE if is_own(topic) else MOST_IN_A_RECORD // 2


def decoder(kind: type[R]) -> tuple[str, Callable[[Any], R]]:
    """The topic and the decoder of a kind of record.

    Raises:
        LookupError: if it is recorded for display only.
    """
    for channel in OF_KIND[kind]:
        if channel.decode is not None:
            return channel.topic, channel.decode
    raise LookupError(f"{kind.__name__} is not read back: its entry in CHANNELS has no decode")
