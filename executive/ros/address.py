"""Where a robot is: `ws://HOST:PORT`, or `wss://` with TLS; and what else its door asks for."""

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from executive.errors import InputError
from executive.text import printable

PORT = 9090
"""Rosbridge's own."""
ROS2 = "ros2:"
"""No address: the ROS 2 that is sourced here, with its own discovery."""
HEADERS = "EXECUTIVE_ROBOT_HEADERS"
"""Environment variable: headers of the connection, in JSON. They are kept nowhere."""


@dataclass(frozen=True)
class Address:
    """A websocket's address; the headers, which may be secret, are shown nowhere."""

    url: str
    headers: Mapping[str, str] = field(default_factory=dict, repr=False)

    def __str__(self) -> str:
        """As a person may see it."""
        return printable(self.url)


def read_address(given: str) -> Address:
    """The address that was given, with a port, and the headers of the environment.

    Raises:
        InputError: if it is none, or the headers are not JSON.
    """
    right = f"give ws://HOST:PORT (wss:// for TLS; rosbridge's port is {PORT}), or {ROS2}"
    if given == ROS2:
        return Address(ROS2)
    try:
        parts = urlsplit(given)
        port = parts.port or PORT
    except ValueError:
        raise InputError("--robot", f"{given[:80]} is no address", right) from None
    if parts.scheme not in ("ws", "wss") or not parts.hostname:
        raise InputError("--robot", f"{given[:80]} is no address of a websocket", right)
    if parts.username or parts.password:
        raise InputError("--robot", "a password in an address is seen by all", f"use {HEADERS}")
    host = f"[{parts.hostname}]" if ":" in parts.hostname else parts.hostname
    query = f"?{parts.query}" if parts.query else ""
    return Address(f"{parts.scheme}://{host}:{port}{parts.path or '/'}{query}", _headers())


def _headers() -> dict[str, str]:
    said = os.environ.get(HEADERS, "")
    if not said:
        return {}
    right = """write for instance '{"Authorization": "Bearer ..."}'"""
    try:
        headers = json.loads(said)
    except ValueError:
        raise InputError(HEADERS, "is not JSON", right) from None
    plain = isinstance(headers, dict) and all(isinstance(one, str) for one in headers.values())
    if not plain or any(c in f"{k}{v}" for k, v in headers.items() for c in "\r\n"):
        raise InputError(HEADERS, "is no table of texts", right)
    return dict(headers)
