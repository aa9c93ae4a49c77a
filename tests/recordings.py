"""Small recordings, sound and not, for the tests that read them."""

import struct
from collections.abc import Callable, Mapping
from pathlib import Path
from zlib import crc32

from mcap.opcode import Opcode
from mcap.records import Chunk
from sample_mission import STARTED, mission

from logs.mcap_sink import McapSink
from logs.recorder import Stamp

MAGIC = b"\x89MCAP0\r\n"
HEAD = struct.Struct("<BQ")


def record_mission(folder: Path, attachments: Mapping[str, bytes] | None = None) -> Path:
    """A run's folder with the sample mission."""
    folder.mkdir(parents=True, exist_ok=True)
    sink = McapSink(folder / "mission.mcap", STARTED, attachments or {}, {"seed": "7"})
    for time, entry in mission():
        sink.write(Stamp(time, 0), entry)
    sink.close()
    return folder


def framed(opcode: int, inside: bytes) -> bytes:
    """A record of an mcap file."""
    return HEAD.pack(opcode, len(inside)) + inside


def chunk(data: bytes, packed: bytes, packing: str, *, size: int | None = None) -> bytes:
    """A chunk that says of itself what it is told to."""
    name = packing.encode()
    inside = struct.pack("<QQQI", 0, 0, len(data) if size is None else size, crc32(data))
    inside += struct.pack("<I", len(name)) + name + struct.pack("<Q", len(packed)) + packed
    return framed(Opcode.CHUNK, inside)


def insert(file: Path, *records: bytes) -> int:
    """Put records before the first chunk; return where."""
    data = file.read_bytes()
    at = offset_of(data, Opcode.CHUNK)
    file.write_bytes(data[:at] + b"".join(records) + data[at:])
    return at


def offset_of(data: bytes, wanted: int) -> int:
    """Where the first record of this kind is."""
    offset = len(MAGIC)
    while (head := HEAD.unpack_from(data, offset))[0] != wanted:
        offset += HEAD.size + head[1]
    return offset


def repack(file: Path, change: Callable[[bytes], bytes]) -> None:
    """Change what is in the chunks, so that every checksum is right again."""
    import zstandard

    data, out, offset = file.read_bytes(), bytearray(MAGIC), len(MAGIC)
    while offset < len(data) - len(MAGIC):
        opcode, length = HEAD.unpack_from(data, offset)
        whole = data[offset : offset + HEAD.size + length]
        if opcode == Opcode.CHUNK:
            size = struct.unpack_from("<Q", whole, HEAD.size + 16)[0]
            packed = whole[HEAD.size + 8 * 3 + 4 + 4 + len("zstd") + 8 :]
            inside = change(zstandard.decompress(packed, max_output_size=size))
            whole = chunk(inside, zstandard.compress(inside), "zstd")
        out += whole
        offset += HEAD.size + length
    file.write_bytes(bytes(out) + MAGIC)


__all__ = ["Chunk", "chunk", "framed", "insert", "offset_of", "record_mission", "repack"]
