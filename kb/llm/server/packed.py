"""Decompresses responses, which some servers compress without being asked to."""

import zlib
from collections.abc import AsyncGenerator

import httpx2

MOST_AT_ONCE = 1 << 16
"""Bytes: compressed data may expand a thousandfold, and the caller limits the total."""
_KNOWN = ("gzip", "x-gzip", "deflate")


class NotUnpacked(Exception):
    """The compression is unknown, or the data is invalid."""


async def unpacked(response: httpx2.Response) -> AsyncGenerator[bytes, None]:
    """The bytes of a response as they arrive, decompressed.

    Raises:
        NotUnpacked: if they cannot be decompressed.
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
