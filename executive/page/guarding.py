"""Who may use the page: who has the token, and comes by an address that is the page's own.

A page of somebody else, open in the same browser, can have the browser send requests to any
address, and by DNS rebinding under a name that it owns. So the request has to name an address of
ours (`Host`), what changes anything has to come from our own page (`Origin`), and all that tells
or does anything needs the token, which no other page can know.
"""

import ipaddress
import secrets
import socket
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any
from urllib.parse import parse_qs

from starlette.responses import PlainTextResponse

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
Site = Callable[[Scope, Receive, Send], Awaitable[None]]

HEADERS = {
    "content-security-policy": "default-src 'none'; script-src 'self'; style-src 'self'; "
    "img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}
WRONG_HOST = "This is not the address of the page. Open the one that the robot's terminal shows."
WRONG_TOKEN = (
    "This address has no token, or one of an earlier start. "
    "Open the one that the robot's terminal shows."
)
WRONG_ORIGIN = "This came from another page."


class Guard:
    """An ASGI application around another one: refuses who may not, and marks what is answered."""

    def __init__(self, site: Site, token: str, address: str, public: frozenset[str]) -> None:
        """Guard the site, which is served at this address; what is public needs no token."""
        self._site = site
        self._token = token
        self._address = address
        self._public = public

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request through, or refuse it."""
        if scope["type"] != "http":
            await self._site(scope, receive, send)
            return

        async def marked(message: MutableMapping[str, Any]) -> None:
            if message["type"] == "http.response.start":
                added = [(name.encode(), value.encode()) for name, value in HEADERS.items()]
                message["headers"] = [*message.get("headers", ()), *added]
            await send(message)

        refusal = self._refusal(scope)
        site = PlainTextResponse(refusal, 403) if refusal else self._site
        await site(scope, receive, marked)

    def _refusal(self, scope: Scope) -> str:
        """Why it may not; empty if it may."""
        headers = {name.decode("latin-1"): v.decode("latin-1") for name, v in scope["headers"]}
        host = headers.get("host", "")
        if not self._is_ours(host):
            return WRONG_HOST
        origin = headers.get("origin")
        own = f"{scope['scheme']}://{host}"
        if scope["method"] != "GET" and origin != own or origin not in (None, own):
            return WRONG_ORIGIN
        if scope["path"] in self._public:
            return ""
        said = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[-1]
        return "" if secrets.compare_digest(said.encode(), self._token.encode()) else WRONG_TOKEN

    def _is_ours(self, host: str) -> bool:
        """Whether somebody else cannot have made the name lead here."""
        name = host.rsplit(":", 1)[0] if not host.endswith("]") else host
        name = name.strip("[]").lower()
        if name in ("localhost", self._address.lower(), *_own_names()):
            return True
        try:
            number = ipaddress.ip_address(name)
        except ValueError:
            return False
        return number.is_loopback or _is_any(self._address)


def parted(root: str, theirs: Site, others: Site) -> Site:
    """Two sites at one address: one at `root` and below, the other one everywhere else."""

    async def site(scope: Scope, receive: Receive, send: Send) -> None:
        path = scope.get("path", "")
        inside = path == root or path.startswith(f"{root}/")
        await (theirs if inside else others)(scope, receive, send)

    return site


def _own_names() -> tuple[str, ...]:
    name = socket.gethostname().lower()
    return name, f"{name}.local"


def _is_any(address: str) -> bool:
    """Whether it means all addresses of the machine: then it may be called by any number."""
    try:
        return ipaddress.ip_address(address).is_unspecified
    except ValueError:
        return False
