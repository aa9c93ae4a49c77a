"""What a server sends, unpacked where it was packed although nobody asked for that."""

import zlib
from collections.abc import AsyncGenerator

import httpx2

MOST_AT_ONCE = 1 << 16
"""Bytes: what is packed may be a thousand times as long, and whoever reads it counts."""
_KNOWN = ("gzip", "x-gzip", "deflate")


class NotUnpacked(Exception):
    """It is packed in a way that is not known, or not as it says."""


async def unpacked(response: httpx2.Response) -> AsyncGenerator[bytes, None]:
    """The bytes of a reply as they come.

    Raises:
        NotUnpacked: if they cannot be had.
    """
    coding = response.headers.get("Content-Encoding", "").strip().lower() or "identity"
    if coding not in ("identity", *_KNOWN):
        raise NotUnpacked(f"it is packed ({coding}), which was not asked for")
    unpacker = zlib.decompressobj(zlib.MAX_WBITS | 32) if coding != "identity" else None
    async for part in response.aiter_raw():
        if unpacker is None:
            yield part
        while unpacker and part and not unpacker.eof:
            try:
                yield unpacker.decompress(part, MOST_AT_ONCE)
            except zlib.error:
                raise NotUnpacked(f"it says that it is packed ({coding}), and is not") from None
            part = unpacker.unconsumed_tail
