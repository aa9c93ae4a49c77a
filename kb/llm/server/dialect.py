"""Adapts requests to a server: what it refuses is omitted, or expressed in another way."""

import re
from collections.abc import Mapping
from typing import Any

from executive.servers.refusal import Refused
from executive.types.llm import ChatRequest
from kb.llm.turns import without_system

OPTIONAL = ("stream_options", "seed", "top_p", "temperature", "stream")
"""Parameters that may be omitted."""
LIMITS = ("max_tokens", "max_completion_tokens", None)
"""Names for the limit of a reply's length; None: it is omitted."""
SCHEMAS = ("json_schema", "json_object", None)
"""Forms of a schema: OpenAI's, that of llama_cpp.server, or none."""

_NO_SYSTEM = re.compile(
    r"\bsystem\b(?!\s+(?:error|fail|is\b|overload|busy|memory|resource))"
    r"|roles?\b.{0,60}(?:alternat|\buser\b)|(?:invalid|unknown|unexpected|bad) role"
    r"|only (?:the )?user and (?:assistant|model)|developer instruction"
    r"|(?:begin|start|first).{0,40}\buser\b|jinja|chat.?template|template.?error",
    re.IGNORECASE | re.DOTALL,
)
_NO_SCHEMA = re.compile(r"response.?format|json.?schema|guided|grammar|structured", re.IGNORECASE)
_TOO_LONG = re.compile(r"context.{0,20}(?:length|window|size)|maximum context", re.IGNORECASE)
_DISLIKES = (400, 422)
"""Statuses of a server that does not accept the content of a request."""


class Dialect:
    """Makes the body of a request as the server accepts it; remembers what it refused."""

    def __init__(
        self, sampling: Mapping[str, float | int], max_tokens: int, *, grammar: bool
    ) -> None:
        """Start with OpenAI's format.

        Args:
            sampling: temperature and the like.
            max_tokens: length limit of a reply (tokens).
            grammar: whether to ask for replies that conform to the request's schema.
        """
        self._sampling = dict(sampling)
        self._max_tokens = max_tokens
        self._limits = list(LIMITS)
        self._schemas = list(SCHEMAS) if grammar else [None]
        self._left_out: set[str] = set()
        self._no_system = False

    def body(self, request: ChatRequest, model: str) -> dict[str, Any]:
        """The body of a request."""
        chat = without_system(request.messages) if self._no_system else request.messages
        body: dict[str, Any] = {
            "model": model,
            "messages": [{"role": m.role, "content": m.content} for m in chat],
            "stream": True,
            "stream_options": {"include_usage": True},
            **self._sampling,
        }
        if self._limits[0]:
            body[self._limits[0]] = self._max_tokens
        match request.schema and self._schemas[0]:
            case "json_schema":
                held = {"name": request.label, "schema": request.schema}
                body["response_format"] = {"type": "json_schema", "json_schema": held}
            case "json_object":
                body["response_format"] = {"type": "json_object", "schema": request.schema}
        if "stream" in self._left_out:
            body["stream"] = False
            body.pop("stream_options")
        return {key: value for key, value in body.items() if key not in self._left_out - {"stream"}}

    def learns(self, refused: Refused, body: Mapping[str, Any]) -> bool:
        """Omit what the server names in its refusal, from now on; whether something was omitted.

        Each time, less is left to refuse, so this terminates.
        """
        if _TOO_LONG.search(refused.says):
            return False
        if _has_system(body) and _NO_SYSTEM.search(refused.says):
            self._no_system = True
            return True
        if self._limits[0] in body and refused.mentions("max_tokens", "max_completion_tokens"):
            self._limits.pop(0)
            return True
        if "response_format" in body and (
            refused.mentions("response_format") or _NO_SCHEMA.search(refused.says)
        ):
            self._schemas.pop(0)
            return True
        sent = {name for name in OPTIONAL if body.get(name, False) is not False}
        named = {name for name in sent if refused.mentions(name)}
        if not named and "stream" in sent and re.search(r"\bstreaming\b", refused.says, re.I):
            named = {"stream"}
        self._left_out |= named
        return bool(named)

    def guesses(self, refused: Refused, body: Mapping[str, Any]) -> bool:
        """Omit something if the server does not say what it refuses; whether that was possible.

        It is not if nothing is left to omit, or if the refusal has another reason.
        """
        if "response_format" in body and refused.status in (*_DISLIKES, 500):
            self._schemas.pop(0)
            return True
        if refused.status not in _DISLIKES or _TOO_LONG.search(refused.says):
            return False
        extra = {name for name in OPTIONAL if name != "stream" and name in body}
        if extra:
            self._left_out |= extra
        elif _has_system(body):
            self._no_system = True
        elif self._limits[0]:
            self._limits.pop(0)
        else:
            return False
        return True


def _has_system(body: Mapping[str, Any]) -> bool:
    return any(turn["role"] == "system" for turn in body["messages"])
