"""Small recordings, sound and not, for the tests that read them."""

import struct
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch
from zlib import crc32

import lz4.frame
import zstandard
from mcap.opcode import Opcode
from sample_mission import STARTED, mission

from executive.records import Record
from logs.recorder import Stamp
from logs.recording import context, sink
from logs.recording.mcap_file import MAGIC
from logs.recording.sink import McapSink

HEAD = struct.Struct("<BQ")
PACK = {"": bytes, "zstd": zstandard.compress, "lz4": lz4.frame.compress}


def record(
    folder: Path,
    records: Iterable[tuple[float, Record]] | None = None,
    attachments: Mapping[str, bytes] | None = None,
    facts: Mapping[str, str] | None = None,
) -> Path:
    """A run's folder with these records, else with the sample mission; each in its own chunk."""
    folder.mkdir(parents=True, exist_ok=True)
    sink = McapSink(folder / "mission.mcap", STARTED, attachments or {}, facts or {"seed": "7"})
    with unchecked():
        for time, entry in mission() if records is None else records:
            sink.write(Stamp(time, 0), entry)
            sink.flush()
    sink.close()
    return folder


@contextmanager
def unchecked() -> Iterator[None]:
    """Write as somebody else might: also what our own reader refuses."""
    with (
        patch.object(sink, "_check_reads", lambda channel, message: None),
        patch.object(context, "in_mission", lambda seconds: seconds),
    ):
        yield


def framed(opcode: int, inside: bytes) -> bytes:
    """A record of an mcap file."""
    return HEAD.pack(opcode, len(inside)) + inside


def chunk(data: bytes, packing: str = "zstd", *, says: int | None = None) -> bytes:
    """A chunk of these data, which may lie about their size."""
    packed = PACK[packing](data)
    size = len(data) if says is None else says
    inside = struct.pack("<QQQII", 0, 0, size, crc32(data), len(packing)) + packing.encode()
    return framed(Opcode.CHUNK, inside + struct.pack("<Q", len(packed)) + packed)


def records_of(data: bytes) -> Iterable[tuple[int, int, bytes]]:
    """Offset, opcode and all bytes of each record of a whole file."""
    offset = len(MAGIC)
    while offset < len(data) - len(MAGIC):
        opcode, length = HEAD.unpack_from(data, offset)
        yield offset, opcode, data[offset : offset + HEAD.size + length]
        offset += HEAD.size + length


def insert(run: Path, *records: bytes) -> int:
    """Put records before the second chunk, the first that has messages; return where."""
    file = run / "mission.mcap"
    data = file.read_bytes()
    _, at, *_ = (offset for offset, opcode, _ in records_of(data) if opcode == Opcode.CHUNK)
    file.write_bytes(data[:at] + b"".join(records) + data[at:])
    return at


def repack(
    run: Path, change: Callable[[bytes], bytes] = lambda inside: inside, packing: str = "zstd"
) -> None:
    """Change what is in the chunks, so that every checksum is right again."""
    file = run / "mission.mcap"
    changed = [MAGIC]
    for _, opcode, whole in records_of(file.read_bytes()):
        if opcode == Opcode.CHUNK:
            packed = whole[HEAD.size + 40 + len("zstd") :]
            inside = change(zstandard.ZstdDecompressor().stream_reader(packed).read())
            whole = chunk(inside, packing)
        changed.append(whole)
    file.write_bytes(b"".join([*changed, MAGIC]))
