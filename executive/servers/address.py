"""Where a model's server is, as people write it."""

import ipaddress
import re
from urllib.parse import SplitResult, urlsplit

from executive.errors import InputError

ENDPOINT = re.compile(r"/(?:chat/)?completions/*$|/models/*$|/audio/transcriptions/*$")
_VERSION = re.compile(r"/v\d[^/]*(?:/openai)?$")


def bases_of(url: str) -> tuple[str, ...]:
    """What an endpoint (`/chat/completions`) may follow, the likeliest first: `http://host` -> `http://host/v1`.

    A slash at the end does no harm, nor does an address that goes on to an endpoint.
    """
    url = ENDPOINT.sub("", url.strip()).rstrip("/")
    if _VERSION.search(url):
        return (url,)
    return (f"{url}/v1", url) if not urlsplit(url).path else (url, f"{url}/v1")


def is_this_machine(url: str) -> bool:
    """Whether no proxy can be meant to lie between."""
    host = urlsplit(url).hostname or ""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


def refuse_secrets(url: str, variable: str) -> None:
    """See that an address can be shown and written down.

    Raises:
        InputError: if it has a user or a password in it, which is not said.
    """
    if "@" in url:
        right = f"put the key into {variable}"
        raise InputError(without_secrets(url), "is given with user and password", right)


def without_secrets(url: str) -> str:
    """The address without user, password, query and fragment, to be shown."""
    try:
        parts = urlsplit(url)
        host = f"[{parts.hostname}]" if ":" in (parts.hostname or "") else parts.hostname or ""
        port = f":{parts.port}" if parts.port else ""
    except ValueError:
        return "an address that cannot be read"
    return SplitResult(parts.scheme, host + port, parts.path, "", "").geturl()
