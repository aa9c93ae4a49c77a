"""The mission as one mcap file, for Foxglove, rerun and `logs.reader`."""

import mimetypes
import os
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path as FilePath
from typing import Any

from mcap.writer import Writer
from mcap_protobuf.schema import register_schema

from executive.records import (
    EventTaken,
    Finished,
    LlmCall,
    Mishap,
    Note,
    Path,
    Picture,
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
from executive.types import Frame
from logs import foxglove, messages
from logs.event_messages import event_to_message, in_words
from logs.recorder import Stamp
from logs.times import nanoseconds
from logs.topics import TOPICS

CHUNK_BYTES = 256 * 1024
"""Larger chunks compress better but stall the writer (and lose more if the process is killed)."""

_MEDIA_TYPES = {".owl": "application/rdf+xml", ".toml": "application/toml"}


class McapSink:
    """Writes an mcap file; `log_time` is run start + mission time.

    A picture's pose becomes `camera_optical` in `map` unless the robot publishes that frame.
    """

    def __init__(
        self,
        path: FilePath,
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
        self._writer.add_metadata("run", {"started": started.isoformat(), **metadata})
        for name, data in attachments.items():
            self._writer.add_attachment(
                self._origin_ns, self._origin_ns, name, _media_type(name), data
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
        """Write a record to its topic or topics; the first is flushed, and all topics with it."""
        self._write(stamp, record)
        if not self._begun:
            self._begun = True
            self.flush()

    def _write(self, stamp: Stamp, record: Record) -> None:
        ns = self._origin_ns + round(stamp.mission_s * 1e9)
        match record:
            case TreeShape():
                self._add_own("/bt/tree", messages.tree_to_message(record), ns, stamp)
            case Tick():
                self._add_own("/bt/tick", messages.tick_to_message(record), ns, stamp)
            case LlmCall():
                self._add_own("/llm/call", messages.llm_call_to_message(record), ns, stamp)
            case Verified():
                self._add_own("/llm/verification", messages.verified_to_message(record), ns, stamp)
            case Utterance(speaker, text):
                self._add_own("/dialog", messages.utterance_to_message(record), ns, stamp)
                self._add_line(Note("info", f"{speaker}: {text}"), ns)
            case EventTaken(event):
                message = event_to_message(event, stamp.mission_s)
                self._add_own("/event", message, ns, stamp)
                self._add_line(Note("debug", in_words(event)), ns)
            case Mishap():
                self._add_line(Note("warning", f"{record.fault}: {record.text}"), ns)
                self._add_own("/mishap", messages.mishap_to_message(record), ns, stamp)
            case Finished(outcome):
                self._add_line(Note("info", f"{outcome.status}: {outcome.reason}"), ns)
                self._add_own("/outcome", messages.outcome_to_message(outcome), ns, stamp)
            case Picture(frame):
                self._add_picture(frame, ns)
            case Seen():
                taken = self._picture[1] if record.frame_number == self._picture[0] else ns
                self._add("/camera/annotations", foxglove.image_annotations(record, taken), ns)
            case Scene(entities):
                self._add("/scene", foxglove.scene_update(entities, ns), ns)
            case Path():
                self._add("/scene", foxglove.path_update(record, ns), ns)
            case Transforms(transforms):
                self._add("/tf", foxglove.frame_transforms(transforms, ns), ns)
                self._camera_frame_published |= any(
                    t.child == foxglove.CAMERA_FRAME for t in transforms
                )
            case Note():
                self._add_line(record, ns)

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

    def _add_picture(self, frame: Frame, ns: int) -> None:
        self._picture = (frame.number, ns)
        if not self._camera_frame_published:
            pose = Transform("map", foxglove.CAMERA_FRAME, frame.pose)
            self._add("/tf", foxglove.frame_transforms([pose], ns), ns)
        self._add("/camera/camera_info", foxglove.camera_calibration(frame, ns), ns)
        self._add("/camera/image/compressed", foxglove.compressed_image(frame, ns), ns)

    def _add_line(self, note: Note, ns: int) -> None:
        self._add("/log", foxglove.log_line(note, ns), ns)

    def _add_own(self, topic: str, message: Any, ns: int, stamp: Stamp) -> None:
        message.timestamp.FromNanoseconds(ns)
        message.wall_time.FromNanoseconds(stamp.wall_ns)
        self._add(topic, message, ns)

    def _add(self, topic: str, message: Any, ns: int) -> None:
        self._writer.add_message(
            self._channels[topic], ns, message.SerializeToString(), ns, self._sequence[topic]
        )
        self._sequence[topic] += 1


def _media_type(name: str) -> str:
    suffix = FilePath(name).suffix
    return _MEDIA_TYPES.get(suffix) or mimetypes.guess_type(name)[0] or "application/octet-stream"
