"""What a server says when it does not do what it was asked."""

import json
import re
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from http import HTTPStatus
from typing import Any

from executive.text import printable

MOST_BYTES = 1 << 16
"""Of a refusal that are read."""
MOST_CHARACTERS = 200
"""Of a server's message that are passed on."""
DEEPEST = 6

_SAYS = ("message", "msg", "detail", "details", "error", "errors", "error_description", "title")
_NAMES = ("param", "loc", "parameter", "field")
_HTML = re.compile(r"\s*<(?:!doctype|html|head|body|\?xml)", re.IGNORECASE)


class Refused(Exception):
    """The server will not have this request.

    Attributes:
        status: HTTP status.
        says: its message; empty if it gives none.
        names: what it names as being at fault, such as parameters.
        wait_s: how long it asks to wait (seconds); None if it does not say.
    """

    def __init__(
        self,
        status: int,
        says: str = "",
        names: frozenset[str] = frozenset(),
        wait_s: float | None = None,
    ) -> None:
        """Say which status, and what else is known."""
        super().__init__(status, says)
        self.status, self.says, self.names, self.wait_s = status, says, names, wait_s

    def __str__(self) -> str:
        """As a clause: "HTTP 429: Rate limit reached"; without a status if that was good."""
        said = printable(" ".join(self.says.split()))
        said = said[:MOST_CHARACTERS] + "..." * (len(said) > MOST_CHARACTERS)
        if self.status == HTTPStatus.OK:
            return said
        return (
            f"HTTP {self.status}: {said}" if said else f"HTTP {self.status} {_phrase(self.status)}"
        )

    def mentions(self, *words: str) -> bool:
        """Whether its message or the names have one of these words."""
        return any(word in self.names or re.search(rf"\b{word}\b", self.says) for word in words)


def refusal(status: int, headers: Mapping[str, str], body: bytes) -> Refused:
    """Read it, in whichever of the usual ways it is written; never raises anything else."""
    text = body.decode(errors="replace")
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        says, names = ("" if _HTML.match(text) else text.strip()), frozenset[str]()
    else:
        says, names = "; ".join(_said(value)), frozenset(_named(value))
    return Refused(status, says, names, _wait_s(headers.get("Retry-After", "")))


def refusal_in(value: dict[str, Any]) -> Refused | None:
    """The refusal in an object of a reply whose status was good; None if it has none."""
    is_one = value.get("object") == "error" or isinstance(value.get("message"), str)
    error = value.get("error") or (is_one and value)
    if not error:
        return None
    code = error.get("code") if isinstance(error, dict) else None
    status = code if isinstance(code, int) and 400 <= code < 600 else 200
    return Refused(status, "; ".join(_said(error)) or "an error", frozenset(_named(error)))


def _said(value: object, depth: int = 0) -> Iterator[str]:
    """The sentences in an error: of OpenAI, of pydantic (a list with places), of others."""
    if isinstance(value, str):
        yield value
    if depth == DEEPEST:
        return
    if isinstance(value, list):
        for part in value[:3]:
            yield from _said(part, depth + 1)
    if isinstance(value, dict):
        place = value.get("loc")
        where = f"{'.'.join(map(str, place))}: " if isinstance(place, list) else ""
        said = next((value[key] for key in _SAYS if value.get(key)), None)
        yield from (where + sentence for sentence in _said(said, depth + 1))


def _named(value: object, depth: int = 0) -> Iterator[str]:
    """What an error names apart from its sentences."""
    if isinstance(value, list) and depth < DEEPEST:
        for part in value[:20]:
            yield from _named(part, depth + 1)
    elif isinstance(value, dict) and depth < DEEPEST:
        for key, part in value.items():
            if key in _NAMES:
                parts = part if isinstance(part, list) else [part]
                yield from (
                    word for one in parts if isinstance(one, str) for word in one.split(".")
                )
            elif key in _SAYS:
                yield from _named(part, depth + 1)


def _wait_s(said: str) -> float | None:
    """Seconds until a time that Retry-After gives, as a number or as a date."""
    try:
        return min(max(0.0, float(said)), 1e9)
    except ValueError:
        pass
    try:
        when = parsedate_to_datetime(said)
    except (ValueError, TypeError, OverflowError):
        return None
    when = when if when.tzinfo else when.replace(tzinfo=UTC)
    return max(0.0, (when - datetime.now(UTC)).total_seconds())


def _phrase(status: int) -> str:
    try:
        return HTTPStatus(status).phrase
    except ValueError:
        return "(no reason given)"
