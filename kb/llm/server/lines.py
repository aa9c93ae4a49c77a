"""Reads the lines of a response as they arrive."""

import re
from codecs import BOM_UTF8
from collections.abc import AsyncGenerator
from contextlib import aclosing

import httpx2

from kb.llm.server.packed import unpacked

MOST_BYTES = 8 << 20
"""Maximum size of a reply (bytes)."""
_ENDS = re.compile(rb"\r\n|\r|\n")


class TooLong(Exception):
    """The reply is too long."""


async def lines(response: httpx2.Response) -> AsyncGenerator[str, None]:
    r"""The lines, with any kind of line end, as soon as each is complete.

    Raises:
        TooLong: if there are too many bytes.
        NotUnpacked: as `unpacked` does.
    """
    begun = list[bytes]()
    size, returned = 0, False
    async with aclosing(unpacked(response)) as parts:
        async for part in parts:
            part = part if size else part.removeprefix(BOM_UTF8)
            part = part.removeprefix(b"\n") if returned else part
            if (size := size + len(part)) > MOST_BYTES:
                raise TooLong(f"it is longer than {MOST_BYTES >> 20} MiB")
            returned = part.endswith(b"\r") or (returned and not part)
            *ended, rest = _ENDS.split(part)
            for line in ended:
                yield b"".join([*begun, line]).decode(errors="replace")
                begun.clear()
            begun.append(rest)
    yield b"".join(begun).decode(errors="replace")
