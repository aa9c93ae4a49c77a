"""The mission as one mcap file, for Foxglove, rerun and `logs.recording.reader`."""

import mimetypes
import os
from collections.abc import Callable, Iterator, Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from mcap.writer import Writer
from mcap_protobuf.schema import register_schema

from executive.records import (
    EventTaken,
    Finished,
    LlmCall,
    Mishap,
    Note,
    Picture,
    PlannedPath,
    Record,
    Scene,
    Seen,
    Tick,
    Transform,
    Transforms,
    TreeShape,
    Utterance,
    Verified,
)
from executive.text import writable
from executive.types import Frame
from logs.recorder import Stamp
from logs.recording import foxglove, messages
from logs.recording.events import event_from_message, event_to_message, in_words
from logs.recording.sound import in_mission
from logs.recording.times import nanoseconds
from logs.recording.topics import TOPICS, most_in

CHUNK_BYTES = 256 * 1024
"""Larger chunks compress better but stall the writer (and lose more if the process is killed)."""

_MEDIA_TYPES = {".owl": "application/rdf+xml", ".toml": "application/toml"}

_READ: dict[str, Callable[[Any], object]] = {
    "/bt/tree": messages.tree_from_message,
    "/bt/tick": messages.tick_from_message,
    "/llm/call": messages.llm_call_from_message,
    "/llm/verification": messages.verified_from_message,
    "/dialog": messages.utterance_from_message,
    "/event": event_from_message,
    "/mishap": messages.mishap_from_message,
    "/outcome": messages.outcome_from_message,
}
"""How our own messages are read: what does not read must not be written, it would cost the rest."""


class McapSink:
    """Writes an mcap file; `log_time` is run start + mission time.

    A picture's pose becomes `camera_optical` in `map` unless the robot publishes that frame.
    """

    def __init__(
        self,
        path: Path,
        started: datetime,
        attachments: Mapping[str, bytes],
        metadata: Mapping[str, str],
    ) -> None:
        """Create the file.

        Args:
            path: where; an existing file is replaced.
            started: wall time at mission time 0 (with time zone).
            attachments: files to keep with the run, by name: ontology, configuration.
            metadata: facts about the run: seed, versions, model.
        """
        self._origin_ns = nanoseconds(started)
        self._file = path.open("wb")
        self._writer: Any = Writer(self._file, chunk_size=CHUNK_BYTES)
        self._writer.start(library="robot-executive")
        facts = {"started": started.isoformat(), **metadata}
        self._writer.add_metadata("run", {name: writable(fact) for name, fact in facts.items()})
        for name, data in attachments.items():
            self._writer.add_attachment(
                self._origin_ns, self._origin_ns, writable(name), _media_type(name), data
            )
        self._channels = {
            topic: self._writer.register_channel(
                topic, "protobuf", register_schema(self._writer, message)
            )
            for topic, message in TOPICS.items()
        }
        self._sequence = dict.fromkeys(TOPICS, 0)
        self._camera_frame_published = False
        self._picture = (-1, 0)
        self._begun = False
        self.flush()

    def write(self, stamp: Stamp, record: Record) -> None:
        """Write a record to its topic or topics; the first is flushed, and all topics with it.

        Of a record that cannot be encoded nothing is written.
        """
        for topic, ns, data in self._encoded(stamp, record):
            self._writer.add_message(self._channels[topic], ns, data, ns, self._sequence[topic])
            self._sequence[topic] += 1
        if not self._begun:
            self._begun = True
            self.flush()

    def _encoded(self, stamp: Stamp, record: Record) -> list[tuple[str, int, bytes]]:
        """Topic, log time (ns) and bytes of all messages that a record becomes."""
        ns = self._origin_ns + round(in_mission(stamp.mission_s) * 1e9)
        if not 0 <= ns < 2**63:
            raise ValueError(f"a mission time of {stamp.mission_s} s")
        told = list(self._messages(stamp, record, ns))
        for topic, message in told:
            if topic in _READ:
                _READ[topic](message)
        found = [(topic, ns, message.SerializeToString()) for topic, message in told]
        for topic, _, data in found:
            most = most_in(topic)
            if len(data) > most:
                raise ValueError(f"{len(data)} bytes, of which at most {most} are read")
        return found

    def _messages(self, stamp: Stamp, record: Record, ns: int) -> Iterator[tuple[str, Any]]:
        def own(message: Any) -> Any:
            message.timestamp.FromNanoseconds(ns)
            message.wall_time.FromNanoseconds(stamp.wall_ns)
            return message

        match record:
            case TreeShape():
                yield "/bt/tree", own(messages.tree_to_message(record))
            case Tick():
                yield "/bt/tick", own(messages.tick_to_message(record))
            case LlmCall():
                yield "/llm/call", own(messages.llm_call_to_message(record))
            case Verified():
                yield "/llm/verification", own(messages.verified_to_message(record))
            case Utterance(speaker, text):
                yield "/dialog", own(messages.utterance_to_message(record))
                yield "/log", foxglove.log_line(Note("info", f"{speaker}: {text}"), ns)
            case EventTaken(event):
                yield "/event", own(event_to_message(event, stamp.mission_s))
                yield "/log", foxglove.log_line(Note("debug", in_words(event)), ns)
            case Mishap(fault, text):
                yield "/log", foxglove.log_line(Note("warning", f"{fault}: {text}"), ns)
                yield "/mishap", own(messages.mishap_to_message(record))
            case Finished(outcome):
                ending = f"{outcome.status}: {outcome.reason}"
                yield "/log", foxglove.log_line(Note("info", ending), ns)
                yield "/outcome", own(messages.outcome_to_message(outcome))
            case Picture(frame):
                yield from self._picture_messages(frame, ns)
            case Seen():
                taken = self._picture[1] if record.frame_number == self._picture[0] else ns
                yield "/camera/annotations", foxglove.image_annotations(record, taken)
            case Scene(entities):
                yield "/scene", foxglove.scene_update(entities, ns)
            case PlannedPath():
                yield "/scene", foxglove.path_update(record, ns)
            case Transforms(transforms):
                yield "/tf", foxglove.frame_transforms(transforms, ns)
                self._camera_frame_published |= any(
                    t.child == foxglove.CAMERA_FRAME for t in transforms
                )
            case Note():
                yield "/log", foxglove.log_line(record, ns)

    def _picture_messages(self, frame: Frame, ns: int) -> Iterator[tuple[str, Any]]:
        self._picture = (frame.number, ns)
        if not self._camera_frame_published:
            pose = Transform("map", foxglove.CAMERA_FRAME, frame.pose)
            yield "/tf", foxglove.frame_transforms([pose], ns)
        yield "/camera/camera_info", foxglove.camera_calibration(frame, ns)
        yield "/camera/image/compressed", foxglove.compressed_image(frame, ns)

    def flush(self) -> None:
        """Finish the chunk and have it written to the disk: it survives process and power."""
        self._writer.flush()
        os.fsync(self._file.fileno())

    def close(self) -> None:
        """Write the index and close the file."""
        try:
            self._writer.finish()
        finally:
            self._file.close()


def _media_type(name: str) -> str:
    suffix = Path(name).suffix
    return _MEDIA_TYPES.get(suffix) or mimetypes.guess_type(name)[0] or "application/octet-stream"
