"""Writes a mission to one mcap file, for Foxglove, rerun and `logs.recording.reader`."""

import mimetypes
import os
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from mcap.writer import Writer
from mcap_protobuf.schema import register_schema

from executive.records import Record
from executive.text import writable
from logs.recorder import Stamp
from logs.recording.channels import OF_KIND, TOPICS, Channel, most_in
from logs.recording.context import Context, nanoseconds

CHUNK_BYTES = 256 * 1024
"""Larger chunks compress better, but stall the writer, and a kill loses more."""

_MEDIA_TYPES = {".owl": "application/rdf+xml", ".toml": "application/toml"}


class McapSink:
    """Writes an mcap file; `log_time` is the start of the run plus the mission time.

    The pose of a picture becomes `camera_optical` in `map`, unless the robot publishes that frame.
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
            path: the file; an existing one is replaced.
            started: wall time at mission time 0 (with time zone).
            attachments: files to store with the run, by name: ontology, configuration.
            metadata: facts about the run: seed, versions, model.

        Raises:
            OSError: if the file cannot be written.
        """
        origin_ns = nanoseconds(started)
        self._file = path.open("wb")
        self._writer: Any = Writer(self._file, chunk_size=CHUNK_BYTES)
        self._writer.start(library="robot-executive")
        facts = {"started": started.isoformat(), **metadata}
        self._writer.add_metadata("run", {name: writable(fact) for name, fact in facts.items()})
        for name, data in attachments.items():
            self._writer.add_attachment(
                origin_ns, origin_ns, writable(name), _media_type(name), data
            )
        self._ids = {
            topic: self._writer.register_channel(
                topic, "protobuf", register_schema(self._writer, message)
            )
            for topic, message in TOPICS.items()
        }
        self._sequence = dict.fromkeys(TOPICS, 0)
        self._context = Context(origin_ns)
        self._begun = False
        self.flush()

    def write(self, stamp: Stamp, record: Record) -> None:
        """Write a record to its topics; nothing, if it cannot be encoded for one of them.

        The first record is flushed at once, so that the file has all topics from then on.
        """
        context = self._context
        context.now(stamp)
        for topic, data in _encoded(record, context):
            self._writer.add_message(
                self._ids[topic], context.ns, data, context.ns, self._sequence[topic]
            )
            self._sequence[topic] += 1
        context.remember(record)
        if not self._begun:
            self._begun = True
            self.flush()

    def flush(self) -> None:
        """Finish the chunk and sync it to the disk: so it survives a kill and a power cut."""
        self._writer.flush()
        os.fsync(self._file.fileno())

    def close(self) -> None:
        """Write the index and close the file."""
        try:
            self._writer.finish()
        finally:
            self._file.close()


def _encoded(record: Record, context: Context) -> list[tuple[str, bytes]]:
    """The topics and bytes of all messages of a record."""
    told = [(channel, channel.encode(record, context)) for channel in OF_KIND[type(record)]]
    return [(c.topic, _bytes(c, message)) for c, message in told if message is not None]


def _bytes(channel: Channel[Any], message: Any) -> bytes:
    _check_reads(channel, message)
    data: bytes = message.SerializeToString()
    most = most_in(channel.topic)
    if len(data) > most:
        raise ValueError(f"{len(data)} bytes, of which at most {most} are read")
    return data


def _check_reads(channel: Channel[Any], message: Any) -> None:
    """Raise if a message could not be read again: readers stop at it, and the rest is lost."""
    if channel.decode is not None:
        channel.decode(message)


def _media_type(name: str) -> str:
    suffix = Path(name).suffix
    return _MEDIA_TYPES.get(suffix) or mimetypes.guess_type(name)[0] or "application/octet-stream"
