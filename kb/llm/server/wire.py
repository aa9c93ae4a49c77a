"""Parses a server's reply as it arrives: a stream of events, or one JSON object."""

import json
from collections.abc import AsyncGenerator, Sequence
from contextlib import aclosing
from dataclasses import dataclass, field
from typing import Any

import httpx2

from executive.servers.refusal import refusal_in
from kb.llm.server.lines import TooLong, lines
from kb.llm.server.packed import NotUnpacked

MOST_TOKENS = 10**9
"""Limit for token counts that a server reports."""
_WORDS = ("content", "text", "response", "refusal")
_REPLIES = frozenset(("choices", "message", "response"))
"""An object with one of these keys is a reply, or a part of one."""
_THOUGHTS = ("reasoning_content", "reasoning", "thinking")
_TOOLS = ("tool_calls", "function_call")
_FIELDS = ("data", "event", "id", "retry", "")
"""Fields of an event; a comment has the empty one."""
_NOTHING = ("", "null")
"""Data of an event that only keeps the connection alive."""
_SIZED = ("Content-Length", "Transfer-Encoding")
"""With one of these headers, a truncated reply is detected."""


class BrokenOff(Exception):
    """The reply is truncated; a retry may help."""


class NotJson(Exception):
    """The response is not a reply."""


@dataclass(slots=True)
class Written:
    """The part of a reply that has arrived."""

    thought: bool = False
    """Whether the model returned its reasoning in a separate field."""
    called: bool = False
    """Whether it called a tool, although it has none."""
    is_reply: bool = False
    """Whether anything arrived that is a reply, or a part of one."""
    others: tuple[str, ...] = ()
    """Keys of the first object that is not a reply."""
    finish_reason: str = ""
    first_token_s: float = 0.0
    chunks: int = 0
    read: int | None = None
    cached: int = 0
    written: int | None = None
    _parts: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """The text so far."""
        return "".join(self._parts)

    def add(self, chunk: dict[str, Any], after_s: float) -> None:
        """Add an object, which arrived `after_s` after the request (s).

        Raises:
            Refused: if it reports an error.
        """
        if refused := refusal_in(chunk):
            raise refused
        self.is_reply = self.is_reply or not _REPLIES.isdisjoint(chunk)
        if not (self.is_reply or self.others):
            self.others = tuple(chunk)
        for choice in _choices(chunk):
            said = next((choice[k] for k in ("delta", "message") if choice.get(k)), choice)
            if isinstance(said, dict):
                self._say(said, after_s)
            reason = choice.get("finish_reason") or choice.get("done_reason")
            self.finish_reason = (
                reason if isinstance(reason, str) and reason else self.finish_reason
            )
        if isinstance(usage := chunk.get("usage"), dict):
            self.read = _count(usage.get("prompt_tokens"))
            self.written = _count(usage.get("completion_tokens"))
            if isinstance(details := usage.get("prompt_tokens_details"), dict):
                self.cached = _count(details.get("cached_tokens")) or 0

    def _say(self, said: dict[str, Any], after_s: float) -> None:
        text = next(filter(None, (_text(said.get(key)) for key in _WORDS)), "")
        self.thought = self.thought or any(said.get(key) for key in _THOUGHTS)
        self.called = self.called or any(said.get(key) for key in _TOOLS)
        if text:
            self.first_token_s = self.first_token_s or after_s
            self._parts.append(text)
            self.chunks += 1


async def objects(response: httpx2.Response) -> AsyncGenerator[dict[str, Any], None]:
    """The JSON objects of a reply: events, one object, or one object a line.

    Raises:
        BrokenOff: if a stream ends without `[DONE]` and may be truncated.
        NotJson: if it is something else.
    """
    reader = _Reader()
    try:
        async with aclosing(lines(response)) as every:
            async for line in every:
                for value in reader.take(line):
                    yield value
                if reader.done:
                    return
    except (TooLong, NotUnpacked) as error:
        raise NotJson(str(error)) from None
    for value in reader.rest():
        yield value
    if not (reader.whole or (reader.events and any(name in response.headers for name in _SIZED))):
        raise BrokenOff("closed the connection without a reply")


class _Reader:
    """Combines the lines of a reply into objects."""

    def __init__(self) -> None:
        self.whole: list[str] = []
        self.events = 0
        self.done = False
        self._event: list[str] = []
        self._strange = ""

    def take(self, line: str) -> list[dict[str, Any]]:
        """The objects completed by this line."""
        mark, colon, data = line.partition(":")
        data = data.strip()
        self.done = data == "[DONE]"
        if self.done or not (line or self.whole):
            return self._end_of_event()
        if self.whole or line.lstrip().startswith(("{", "[", "<")):
            self.whole.append(line)
        elif colon and data not in _NOTHING and mark in ("data", "error"):
            self._event.append(data if mark == "data" else f'{{"error": {data}}}')
        elif mark not in _FIELDS:
            self._strange = self._strange or line
        return []

    def rest(self) -> list[dict[str, Any]]:
        """The objects completed by the end of the reply."""
        if self._strange and not (self.whole or self.events or self._event):
            raise NotJson(self._strange)
        return [*self._end_of_event(), *_objects(self.whole)]

    def _end_of_event(self) -> list[dict[str, Any]]:
        ended = _objects(self._event)
        self._event.clear()
        self.events += len(ended)
        return ended


def _objects(said: Sequence[str]) -> list[dict[str, Any]]:
    """One object over all lines, or one object for each line."""
    filled = [line for line in said if line.strip()]
    if not filled:
        return []
    try:
        return [_object("\n".join(filled))]
    except NotJson:
        if not all(line.startswith("{") and line.rstrip().endswith("}") for line in filled):
            raise
    return [_object(line) for line in filled]


def _object(data: str) -> dict[str, Any]:
    try:
        value = json.loads(data)
    except (ValueError, RecursionError):
        raise NotJson(data) from None
    if not isinstance(value, dict):
        raise NotJson(data)
    return value


def _text(content: object) -> str:
    """The text in a string, or in the text parts of a list."""
    if isinstance(content, str):
        return content
    if isinstance(content, list):
        return "".join(part if isinstance(part, str) else _text_of(part) for part in content)
    return ""


def _text_of(part: object) -> str:
    text = part.get("text") if isinstance(part, dict) else None
    return text if isinstance(text, str) else ""


def _count(value: object) -> int | None:
    """A token count, if it is a valid one."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return int(value) if 0 <= value < MOST_TOKENS and value == int(value) else None


def _choices(chunk: dict[str, Any]) -> list[dict[str, Any]]:
    """The first choice, in OpenAI's format or in Ollama's own."""
    if isinstance(chunk.get("message"), dict) or isinstance(chunk.get("response"), str):
        return [chunk]
    return [c for c in _dicts(chunk.get("choices")) if c.get("index") in (0, None)]


def _dicts(value: object) -> list[dict[str, Any]]:
    return [part for part in value if isinstance(part, dict)] if isinstance(value, list) else []
