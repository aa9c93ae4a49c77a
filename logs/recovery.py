"""Reading mcap files that end early or are damaged, and making them whole again."""

import contextlib
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Chunk, Header, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import Writer
from zstandard import ZstdError

from executive.errors import InputError
from logs.mcap_sink import CHUNK_BYTES

BREAKS = (McapError, struct.error, ZstdError, ValueError, UnicodeDecodeError, EOFError)
"""What reading raises where a file ends early or is damaged."""


def is_whole(path: Path) -> bool:
    """Whether the file has the index that is written last.

    Raises:
        InputError: if it is no mcap file at all.
    """
    try:
        with path.open("rb") as file:
            if not isinstance(next(StreamReader(file).records, None), Header):
                raise InputError(str(path), "is not an mcap file", "the magic number is missing")
            file.seek(0)
            with contextlib.suppress(*BREAKS):
                return make_reader(file).get_summary() is not None
            return False
    except OSError as error:
        raise InputError(str(path), error.strerror or "cannot be read") from error
    except BREAKS as error:
        raise InputError(str(path), "is not an mcap file", "its header is missing") from error


class SoundRecords:
    """The records of a file that read: damaged chunks are passed over, a break ends it."""

    def __init__(self, path: Path) -> None:
        """Read this file when iterated over."""
        self._path = path
        self.damaged_at: int | None = None
        """Offset (bytes) of the first record that does not read, as far as was iterated."""

    def __iter__(self) -> Iterator[McapRecord]:
        """All records, those in chunks singly."""
        with self._path.open("rb") as file:
            offset = 0
            try:
                for record in StreamReader(file, emit_chunks=True).records:
                    if isinstance(record, Chunk):
                        yield from self._inside(record, offset)
                    else:
                        yield record
                    offset = file.tell()
            except BREAKS:
                self._note(offset)

    def _inside(self, chunk: Chunk, offset: int) -> Iterator[McapRecord]:
        try:
            records = list(breakup_chunk(chunk, validate_crc=True))
        except BREAKS:
            self._note(offset)
            return
        yield from records

    def _note(self, offset: int) -> None:
        if self.damaged_at is None:
            self.damaged_at = offset


def damaged_at(path: Path) -> int | None:
    """Offset (bytes) of the first record that does not read; None if all do."""
    records = SoundRecords(path)
    for _ in records:
        pass
    return records.damaged_at


def recover(path: Path) -> Path:
    """Write what can be read of a broken file to `<name>.recovered.mcap` beside it.

    Raises:
        InputError: if it is no mcap file at all.
    """
    is_whole(path)
    target = path.with_suffix(".recovered.mcap")
    with target.open("wb") as file:
        writer: Any = Writer(file, chunk_size=CHUNK_BYTES)
        schemas: dict[int, int] = {0: 0}
        channels: dict[int, int] = {}
        for record in SoundRecords(path):
            match record:
                case Header():
                    writer.start(record.profile, record.library)
                case Schema() if record.id not in schemas:
                    schemas[record.id] = writer.register_schema(
                        record.name, record.encoding, record.data
                    )
                case Channel() if record.id not in channels:
                    channels[record.id] = writer.register_channel(
                        record.topic,
                        record.message_encoding,
                        schemas[record.schema_id],
                        record.metadata,
                    )
                case Message() if record.channel_id in channels:
                    writer.add_message(
                        channels[record.channel_id],
                        record.log_time,
                        record.data,
                        record.publish_time,
                        record.sequence,
                    )
                case Attachment():
                    writer.add_attachment(
                        record.create_time,
                        record.log_time,
                        record.name,
                        record.media_type,
                        record.data,
                    )
                case Metadata():
                    writer.add_metadata(record.name, record.metadata)
        writer.finish()
    return target
