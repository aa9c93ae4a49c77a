"""A reply of a server as it comes in: a stream of events, or one JSON object."""

import json
import re
from codecs import BOM_UTF8
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from typing import Any

import httpx2

from kb.refusal import refusal_in

MOST_BYTES = 8 << 20
"""Of one reply."""
MOST_TOKENS = 10**9
"""Of what a server may say that it counted."""
_THOUGHTS = ("reasoning_content", "reasoning", "thinking")
_LINE_ENDS = re.compile(rb"[\r\n]")


class BrokenOff(Exception):  # noqa: N818 - what happened
    """The server did not get to its end; trying again may help."""


class NotJson(Exception):  # noqa: N818 - what it is
    """What came is no reply."""


@dataclass(slots=True)
class Written:
    """What has come of a reply so far."""

    thought: bool = False
    """Whether the model thought in a field of its own."""
    finish_reason: str = ""
    first_token_s: float = 0.0
    chunks: int = 0
    read: int | None = None
    cached: int = 0
    written: int | None = None
    _parts: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """All that was said so far."""
        return "".join(self._parts)

    def add(self, chunk: dict[str, Any], after_s: float) -> None:
        """Take in one object, which came so long after the request.

        Raises:
            Refused: if it tells an error.
        """
        if refused := refusal_in(chunk):
            raise refused
        for choice in _dicts(chunk.get("choices")):
            said = next((choice[k] for k in ("delta", "message") if choice.get(k)), choice)
            if isinstance(said, dict):
                self._say(said, after_s)
            reason = choice.get("finish_reason")
            self.finish_reason = (
                reason if isinstance(reason, str) and reason else self.finish_reason
            )
        if isinstance(usage := chunk.get("usage"), dict):
            self.read = _count(usage.get("prompt_tokens"))
            self.written = _count(usage.get("completion_tokens"))
            if isinstance(details := usage.get("prompt_tokens_details"), dict):
                self.cached = _count(details.get("cached_tokens")) or 0

    def _say(self, said: dict[str, Any], after_s: float) -> None:
        text = _text(said.get("content")) or _text(said.get("text")) or _text(said.get("refusal"))
        self.thought = self.thought or any(said.get(key) for key in _THOUGHTS)
        if text:
            self.first_token_s = self.first_token_s or after_s
            self._parts.append(text)
            self.chunks += 1


async def objects(response: httpx2.Response) -> AsyncIterator[dict[str, Any]]:
    """The JSON objects of a reply.

    Raises:
        BrokenOff: if a stream ends without `[DONE]`, which is no harm after a finish reason.
        NotJson: if it is something else.
    """
    whole: list[str] = []
    async for line in _lines(response):
        mark, colon, data = line.partition(":")
        data = data.strip()
        if data == "[DONE]":
            return
        if whole or line.lstrip().startswith(("{", "[", "<")):
            whole.append(line)
        elif colon and data and mark == "data":
            yield _object(data)
        elif colon and data and mark == "error":
            yield {"error": _object(data)}
    if not whole:
        raise BrokenOff("closed the connection without a reply")
    yield _object("\n".join(whole))


async def _lines(response: httpx2.Response) -> AsyncIterator[str]:
    """The lines of a reply, whichever way they end, as soon as each is there."""
    if (coding := response.headers.get("Content-Encoding", "identity")) != "identity":
        raise NotJson(f"it is packed ({coding}), which was not asked for")
    begun: list[bytes] = []
    size = 0
    async for part in response.aiter_raw():
        if not size:
            part = part.removeprefix(BOM_UTF8)
        if (size := size + len(part)) > MOST_BYTES:
            raise NotJson(f"it is longer than {MOST_BYTES >> 20} MiB")
        *ended, rest = _LINE_ENDS.split(part)
        for line in ended:
            yield b"".join([*begun, line]).decode(errors="replace")
            begun.clear()
        begun.append(rest)
    yield b"".join(begun).decode(errors="replace")


def _object(data: str) -> dict[str, Any]:
    try:
        value = json.loads(data)
    except (ValueError, RecursionError):
        raise NotJson(data) from None
    if not isinstance(value, dict):
        raise NotJson(data)
    return value


def _text(content: object) -> str:
    """What is said: a text, or a list of parts of which some are text."""
    if isinstance(content, str):
        return content
    if isinstance(content, list):
        return "".join(part if isinstance(part, str) else _text_of(part) for part in content)
    return ""


def _text_of(part: object) -> str:
    text = part.get("text") if isinstance(part, dict) else None
    return text if isinstance(text, str) else ""


def _count(value: object) -> int | None:
    """A number of tokens, if it can be one."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return int(value) if 0 <= value < MOST_TOKENS and value == int(value) else None


def _dicts(value: object) -> list[dict[str, Any]]:
    return [part for part in value if isinstance(part, dict)] if isinstance(value, list) else []
