"""Where the page is served, and the options that say so."""

import argparse
import ipaddress
import logging
import socket
import ssl
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from executive.errors import InputError

PORT = 8080
LOCAL = "127.0.0.1"
UNENCRYPTED = "the page is open to the network, unencrypted: give --page-cert and --page-key"

EXAMPLES = {"0.0.0.0": "192.0.2.1", "::": "2001:db8::1"}
"""Of all addresses of this machine, in each numbering, one elsewhere that is nobody's (RFC 5737,
RFC 3849)."""

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Address:
    """Where the page is to be.

    Attributes:
        port: 0 for any that is free.
        host: of this machine: a name or a number; `0.0.0.0` or `::` for all of them.
        certificate: PEM file, for https.
        key: PEM file of the certificate's private key, if that has none in it.
        experimenter: whether the experimenter has a page, too.
    """

    port: int = PORT
    host: str = LOCAL
    certificate: Path | None = None
    key: Path | None = None
    experimenter: bool = False

    @property
    def is_local(self) -> bool:
        """Whether nobody reaches it from outside of this machine."""
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return self.host == "localhost"

    @property
    def scheme(self) -> str:
        """How an address begins there."""
        return "https" if self.certificate else "http"

    def url(self, port: int, token: str, path: str = "/") -> str:
        """What to open in a browser; of all addresses, one that other devices reach."""
        named = _outward(self.host)
        host = f"[{named}]" if ":" in named else named
        return f"{self.scheme}://{host}:{port}{path}?token={token}"

    def checked(self) -> None:
        """See that the files can be used; say what is unwise.

        Raises:
            InputError: if they cannot.
        """
        if self.certificate is None:
            if self.key is not None:
                raise InputError("--page-key", "there is no certificate", "give --page-cert, too")
            if not self.is_local:
                log.warning(UNENCRYPTED)
            return
        try:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(self.certificate, self.key, password="")
        except (ssl.SSLError, ValueError):
            raise _unusable("is no PEM of that") from None
        except OSError as error:
            raise _unusable(str(error.strerror)) from None


def _unusable(why: str) -> InputError:
    right = "give a certificate and its key without a password"
    return InputError("--page-cert", f"cannot be used: {why}", right)


def add_page(parser: argparse.ArgumentParser, *, experimenter: bool = True) -> None:
    """Add the options of the page to a command line; of the experimenter's, if it may have one."""
    what = "talk by a page" if experimenter else "where they are shown"
    parser.add_argument(
        "--page",
        nargs="?",
        type=_port,
        const=PORT,
        metavar="PORT",
        help=f"{what} in the browser, on this machine (default port: {PORT})",
    )
    parser.add_argument(
        "--page-address", metavar="ADDRESS", help="of this machine, for other devices; 0.0.0.0: all"
    )
    parser.add_argument(
        "--page-cert", type=Path, metavar="FILE", help="certificate (PEM), for https"
    )
    if experimenter:
        parser.add_argument(
            "--page-experimenter",
            action="store_true",
            help="serve the experimenter's page, too, at an address of its own",
        )
    parser.add_argument("--page-key", type=Path, metavar="FILE", help="its private key (PEM)")


def address_of(options: dict[str, Any]) -> Address | None:
    """What these options say, which are taken out; None if no page is wanted.

    Raises:
        InputError: if something is said of a page that is not wanted.
    """
    names = ("page", "page_address", "page_cert", "page_key", "page_experimenter")
    port, host, *others = given = [options.pop(name) for name in names]
    if port is not None:
        return Address(port, host or LOCAL, *others)
    for name, value in zip(names, given, strict=True):
        if value:
            option = f"--{name.replace('_', '-')}"
            raise InputError(option, "no page is served that this could be of", "give --page, too")
    return None


def _port(text: str) -> int:
    """A number of a port; 0 is any that is free."""
    if text.isascii() and text.isdecimal() and int(text) < 2**16:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r} is no port: words go before --page")


def _outward(host: str) -> str:
    """The address itself, or for all of them that by which this machine speaks to others."""
    if host not in EXAMPLES:
        return host
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        with socket.socket(family, socket.SOCK_DGRAM) as asking:
            asking.connect((EXAMPLES[host], 9))  # finds the way; nothing is sent
            return str(asking.getsockname()[0])
    except OSError:  # it is in no network
        return host
