"""Repairs mcap files that are incomplete or damaged."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from mcap.records import Attachment, Channel, Header, McapRecord, Message, Metadata, Schema
from mcap.writer import Writer

from executive.errors import InputError
from logs.recording.mcap_file import Damage, records
from logs.recording.sink import CHUNK_BYTES


def first_damage(path: Path) -> tuple[int, Damage] | None:
    """The first damage and its offset (bytes); None if everything can be read.

    Raises:
        InputError: if it is not an mcap file.
    """
    found = ((at, record) for at, record in records(path) if isinstance(record, Damage))
    return next(found, None)


def recover(path: Path) -> Path:
    """Write what can be read of a damaged file to `<name>.recovered.mcap` next to it.

    The new file appears when it is complete, or not at all; the damaged file is not changed.

    Raises:
        InputError: if it is not an mcap file, nothing of it can be read, or no file can be written.
    """
    target = path.with_name(f"{path.stem}.recovered.mcap")
    with written(target) as file:
        _copy(path, file)
    return target


@contextmanager
def written(target: Path) -> Iterator[IO[bytes]]:
    """A temporary file; takes the name of `target` when it is complete, else it is removed.

    Raises:
        InputError: if it cannot be written.
    """
    try:
        with tempfile.NamedTemporaryFile(
            dir=target.parent, prefix=f".{target.name}.", delete=False
        ) as file:
            new = Path(file.name)
            try:
                yield file
                file.flush()
                os.fsync(file.fileno())
                new.chmod(0o666 & ~_umask())
                new.replace(target)
            except BaseException:
                new.unlink(missing_ok=True)
                raise
    except OSError as error:
        right = "name a file in a folder that can be written to and has room"
        raise InputError(str(target), f"cannot be written: {error.strerror}", right) from error


def _umask() -> int:
    """The process's mask for new files, which can only be read by setting it."""
    mask = os.umask(0o022)
    os.umask(mask)
    return mask


def _copy(path: Path, file: IO[bytes]) -> None:
    copy: _Copy | None = None
    for _, record in records(path):
        if isinstance(record, Header) and copy is None:
            copy = _Copy(file, record)
        elif copy is not None and not isinstance(record, Damage):
            copy.add(record)
    if copy is None:
        raise InputError(str(path), "nothing of it can be read", "its header is damaged")
    copy.finish()


class _Copy:
    """Copies records with what they refer to; records with missing references are skipped."""

    def __init__(self, file: IO[bytes], header: Header) -> None:
        self._writer: Any = Writer(file, chunk_size=CHUNK_BYTES)
        self._writer.start(header.profile, header.library)
        self._schemas = {0: 0}
        self._channels: dict[int, int] = {}

    def add(self, record: McapRecord) -> None:
        writer = self._writer
        match record:
            case Schema() if record.id not in self._schemas:
                schema = writer.register_schema(record.name, record.encoding, record.data)
                self._schemas[record.id] = schema
            case Channel() if record.id not in self._channels and record.schema_id in self._schemas:
                self._channels[record.id] = writer.register_channel(
                    record.topic,
                    record.message_encoding,
                    self._schemas[record.schema_id],
                    record.metadata,
                )
            case Message() if record.channel_id in self._channels:
                writer.add_message(
                    self._channels[record.channel_id],
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

    def finish(self) -> None:
        self._writer.finish()
