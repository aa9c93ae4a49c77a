"""Reads records of an mcap file that may come from a stranger: sizes are checked first.

The framing and the messages are parsed here (https://mcap.dev/spec). Other records are parsed by
mcap's own classes, from no more bytes than they have; a chunk is decompressed to no more than its
declared and allowed size. The index at the end of a file is never used, as it may be wrong.
"""

import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import IO, Any
from zlib import crc32

import lz4.frame
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Header, McapRecord, Message, Metadata, Schema

from executive.errors import InputError

MAGIC = b"\x89MCAP0\r\n"
MiB = 1024 * 1024
MOST_IN_A_RECORD = 256 * MiB
"""Maximum size of a record, and of a decompressed chunk (bytes)."""
MOST_IN_A_FACT = MiB
"""Maximum size of a record about others: a schema, a channel, metadata (bytes)."""
MOST_KEPT = 256 * MiB
"""Maximum size of all attachments together (bytes)."""
MOST_RECORDS = 1_000_000
"""Limit for the records in a file, in chunks or not: ten hours of a robot that always moves."""
MOST_UNPACKED, MOST_PACKED_TIMES = 64 * MiB, 100
"""Limit for a decompressed file: this many bytes, plus this many times its own size.

A mission's file is only twice as large decompressed.
"""

_HEAD = struct.Struct("<BQ")
_MESSAGE = struct.Struct("<HIQQ")
_TOO_MANY = f"there are more than the {MOST_RECORDS} records that are read"
_FOOTER_BYTES = _HEAD.size + 20
_BROKEN = (McapError, struct.error, zstandard.ZstdError, RuntimeError, ValueError, OverflowError)
"""The exceptions of the record parsers; that of lz4 is a RuntimeError."""


@dataclass(frozen=True, slots=True)
class Damage:
    """What cannot be read, and why; `cut`: the file breaks off there, or has only zeros left."""

    what: str
    cut: bool = False


Found = tuple[int, McapRecord | Damage]
"""The offset (bytes) of a record, or of the chunk that contains it, and the record."""


class _Unsound(ValueError):
    """A record contradicts its own declarations."""


def is_whole(path: Path) -> bool:
    """Whether the file was closed: it ends as mcap files do.

    Raises:
        InputError: if it is not an mcap file, or cannot be read.
    """
    try:
        with path.open("rb") as file:
            if file.read(len(MAGIC)) != MAGIC:
                what = "is not an mcap file: it does not begin as one"
                raise InputError(str(path), what, "name a run's folder or its mission.mcap")
            size = file.seek(0, 2)
            file.seek(max(0, size - _FOOTER_BYTES - len(MAGIC)))
            end = file.read()
    except OSError as error:
        raise InputError(str(path), error.strerror or "cannot be read") from error
    return end.startswith(_HEAD.pack(Opcode.FOOTER, 20)) and end.endswith(MAGIC)


def records(path: Path) -> Iterator[Found]:
    """All records, including those in chunks; unreadable ones are replaced by `Damage`.

    After damage, it continues if the next record can be found. Indexes and unknown kinds of
    records are skipped.

    Raises:
        InputError: if it is not an mcap file, or cannot be read.
    """
    is_whole(path)
    try:
        with path.open("rb") as file:
            yield from _Walk(file, path.stat().st_size)
    except OSError as error:
        raise InputError(str(path), error.strerror or "cannot be read") from error


class _Walk:
    """Iterates over the records of one file."""

    def __init__(self, file: IO[bytes], size: int) -> None:
        self._file = file
        self._size = size
        self._may_unpack = MOST_UNPACKED + MOST_PACKED_TIMES * size
        self._may_keep = MOST_KEPT
        self._may_find = MOST_RECORDS

    def __iter__(self) -> Iterator[Found]:
        offset = len(MAGIC)
        while True:
            self._file.seek(offset)
            head = self._file.read(_HEAD.size)
            if len(head) < _HEAD.size:
                yield offset, Damage("the file ends early", cut=True)
                return
            opcode, length = _HEAD.unpack(head)
            end = offset + _HEAD.size + length
            if end > self._size:
                yield offset, Damage("a record reaches beyond the end of the file", cut=True)
                return
            if opcode == 0:
                yield offset, Damage("there is no record", cut=self._is_blank(offset))
                return
            if opcode == Opcode.FOOTER:
                self._file.seek(end + len(MAGIC))
                if self._file.read(len(MAGIC)) == MAGIC:
                    yield end + len(MAGIC), Damage("another file begins here, which is not read")
                return
            if not self._may_find:
                yield offset, Damage(_TOO_MANY)
                return
            self._may_find -= 1
            yield from ((offset, found) for found in self._found(opcode, length, end))
            offset = end

    def _found(self, opcode: int, length: int, end: int) -> Iterator[McapRecord | Damage]:
        """The record, or the records in a chunk; the file is positioned at its content."""
        try:
            record = self._record(opcode, length)
            if isinstance(record, Chunk):
                yield from self._inside(record)
            elif record is not None:
                yield record
        except _BROKEN as error:
            yield Damage(_why(error), cut=end == self._size)

    def _record(self, opcode: int, length: int) -> McapRecord | None:
        if opcode not in _READ:
            return None
        _, name, most = _READ[opcode]
        if opcode == Opcode.ATTACHMENT:
            most = min(most, self._may_keep)
        if length > most:
            raise _Unsound(f"{name} of {length} bytes is more than the {most} that are read")
        inside = self._file.read(length)
        record = _read(opcode, inside)
        if isinstance(record, Attachment):
            self._may_keep -= length
            recorded = int.from_bytes(inside[-4:], "little")
            _check_sum(f"attachment {record.name}", inside[:-4], recorded)
        return record

    def _inside(self, chunk: Chunk) -> Iterator[McapRecord]:
        """The records of a chunk; raises before the first if its size or checksum is wrong."""
        most = min(MOST_IN_A_RECORD, self._may_unpack)
        if chunk.uncompressed_size > most:
            raise _Unsound(
                f"a chunk unpacks to {chunk.uncompressed_size} bytes, more than the {most} "
                "that are read of a file of this size"
            )
        self._may_unpack -= chunk.uncompressed_size
        data = _unpacked(chunk)
        if len(data) != chunk.uncompressed_size:
            raise _Unsound(f"a chunk does not unpack to its {chunk.uncompressed_size} bytes")
        _check_sum("a chunk", data, chunk.uncompressed_crc)
        return self._split(data)

    def _split(self, data: bytes) -> Iterator[McapRecord]:
        position = 0
        while position < len(data):
            if not self._may_find:
                raise _Unsound(_TOO_MANY)
            self._may_find -= 1
            opcode, length = _HEAD.unpack_from(data, position)
            start = position + _HEAD.size
            position = start + length
            if position > len(data) or not opcode:
                raise _Unsound("a record in a chunk is none, or reaches beyond the chunk")
            if opcode in (Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE):
                yield _read(opcode, data[start:position])

    def _is_blank(self, offset: int) -> bool:
        """Whether the rest of the file is only zeros, as after a power failure."""
        self._file.seek(offset)
        blocks = iter(lambda: self._file.read(MiB), b"")
        return not any(block.strip(b"\0") for block in blocks)


_READ: dict[int, tuple[Callable[[ReadDataStream], McapRecord] | None, str, int]] = {
    Opcode.HEADER: (Header.read, "a header", MOST_IN_A_FACT),
    Opcode.SCHEMA: (Schema.read, "a schema", MOST_IN_A_FACT),
    Opcode.CHANNEL: (Channel.read, "a channel", MOST_IN_A_FACT),
    Opcode.METADATA: (Metadata.read, "metadata", MOST_IN_A_FACT),
    Opcode.MESSAGE: (None, "a message", MOST_IN_A_RECORD),
    Opcode.CHUNK: (Chunk.read, "a chunk", MOST_IN_A_RECORD),
    Opcode.ATTACHMENT: (Attachment.read, "an attachment", MOST_KEPT),
}
"""For each opcode: the parser (None: parsed here), a name, and the maximum size (bytes)."""


def _read(opcode: int, inside: bytes) -> McapRecord:
    read, name, most = _READ[opcode]
    if len(inside) > most:
        raise _Unsound(f"{name} of {len(inside)} bytes is more than the {most} that are read")
    if read is not None:
        return read(ReadDataStream(BytesIO(inside)))
    channel, sequence, log_time, publish_time = _MESSAGE.unpack_from(inside)
    return Message(channel, log_time, inside[_MESSAGE.size :], publish_time, sequence)


def _unpacked(chunk: Chunk) -> bytes:
    """Decompress at most one byte more than the chunk declares, whatever the packed data say."""
    most = chunk.uncompressed_size + 1
    match chunk.compression:
        case "":
            return chunk.data
        case "zstd":
            return zstandard.ZstdDecompressor().stream_reader(chunk.data).read(most)
        case "lz4":
            unpacking: Any = lz4.frame.LZ4FrameDecompressor()
            unpacked: bytes = unpacking.decompress(chunk.data, max_length=most)
            return unpacked
    raise _Unsound(f"a chunk is packed in an unknown way, {chunk.compression!r}")


def _check_sum(what: str, data: bytes, recorded: int) -> None:
    """Raise if the checksum is wrong; 0 means that there is none."""
    if recorded and crc32(data) != recorded:
        raise _Unsound(f"the checksum of {what} is wrong")


def _why(error: Exception) -> str:
    return str(error) if isinstance(error, _Unsound) else f"a record is broken ({error!r})"
